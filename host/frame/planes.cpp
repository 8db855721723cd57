#include "gloam/planes.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "gloam/error.h"

namespace gloam {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

PlaneKind kind(std::string name, std::vector<std::string> components, std::vector<std::string> channels, float outside,
               PlaneKind::Meaning meaning, std::string help, std::string source = "") {
  return {std::move(name), std::move(components), std::move(channels), outside,
          meaning,         std::move(help),       std::move(source)};
}

/// A colour with the channels NAME.R, NAME.G and NAME.B.
PlaneKind colour(const std::string& name, float outside, std::string help) {
  return kind(name, {"r", "g", "b"}, {name + ".R", name + ".G", name + ".B"}, outside, PlaneKind::value,
              std::move(help));
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

}  // namespace

const std::vector<PlaneKind>& plane_kinds() {
  using K = PlaneKind;
  static const std::vector<PlaneKind> kinds = {
      kind("depth", {""}, {"Z"}, inf, K::view_depth, "planar view-space distance, scene units; background is +inf"),
      kind("normal", {"x", "y", "z"}, {"N.X", "N.Y", "N.Z"}, 0, K::unit_vector, "unit, view space"),
      kind("color", {"r", "g", "b"}, {"R", "G", "B"}, 0, K::value, "scene-linear radiance"),
      kind("alpha", {""}, {"A"}, 0, K::unit_interval, "coverage; 0 is background"),
      kind("albedo", {"r", "g", "b"}, {"albedo.R", "albedo.G", "albedo.B"}, 0, K::unit_interval, "base colour"),
      colour("ambient", 0, "ambient light that a surface reflects towards the eye, without occlusion; part of `color`"),
      colour("emission", 0, "light that surfaces send of their own; part of `color`, not darkened by occlusion"),
      colour("backdrop", 0, "light of what lies behind all surfaces; part of `color`, not darkened by occlusion"),
      colour("volume", 0, "light that fog and volumes send to the eye; part of `color`, not darkened by occlusion"),
      colour("transmission", 0, "light seen through surfaces; part of `color`, not darkened by occlusion"),
      colour("illumination", 0,
             "diffuse light that arrives at a surface, times `albedo` part of `color`: what occlusion darkens"),
      kind("metallic", {""}, {"metallic"}, 0, K::unit_interval, "1 is metal, whose albedo is no diffuse one"),
      kind("roughness", {""}, {"roughness"}, 1, K::unit_interval, "perceptual; GGX alpha is its square"),
      kind("reflectance", {"r", "g", "b"}, {"reflectance.R", "reflectance.G", "reflectance.B"}, 0, K::unit_interval,
           "specular reflectance at normal incidence (F0)"),
      kind("position", {"x", "y", "z"}, {"P.X", "P.Y", "P.Z"}, 0, K::value,
           "world space, relative to the attribute gloamOrigin where present"),
      kind("back_depth", {""}, {"backZ"}, inf, K::view_depth,
           "first back face of the same instance behind the visible surface"),
      kind("instance", {""}, {"instance"}, 0, K::value, "identity of the instance seen"),
      kind("peel_count", {""}, {"peel.count"}, 0, K::value, "how many surfaces lie under the pixel centre"),
      kind("outline_count", {""}, {"outline.count"}, 0, K::value, "signed crossings in front of the surface",
           "gloam capture --outlines EXTENT"),
      kind("seen_by_both", {""}, {"both"}, 0, K::value, "1 where both of two eyes see the surface"),
      kind("mask", {""}, {"mask"}, 0, K::unit_interval, "where an effect is wanted"),
      kind("motion", {"x", "y"}, {"motion.X", "motion.Y"}, 0, K::value, "pixels, current to previous frame, y down"),
      kind("ao", {""}, {"AO"}, 1, K::unit_interval, "ambient occlusion; 1 is open"),
      kind("ao_raw", {""}, {"AO_raw"}, 1, K::unit_interval, "ambient occlusion before filtering"),
      kind("ao_error", {""}, {"AO_error"}, 0, K::unit_interval, "expected absolute error of `ao`"),
      kind("ao_noise", {""}, {"AO_noise"}, 0, K::value, "estimated error of a ray-traced AO"),
      kind("bent_normal", {"x", "y", "z"}, {"bent.X", "bent.Y", "bent.Z"}, 0, K::unit_vector,
           "mean unoccluded direction, view space"),
      kind(
          "cone", {""}, {"cone"}, 0, K::unit_interval,
          "cosine of the half angle of the cone about bent_normal that is as open; 0 is a whole hemisphere, 1 nothing"),
      kind("reflection", {"r", "g", "b", "a"}, {"reflection.R", "reflection.G", "reflection.B", "reflection.A"}, 0,
           K::value, "reflected radiance; A is the confidence"),
      kind("reflection_raw", {"r", "g", "b", "a"},
           {"reflection_raw.R", "reflection_raw.G", "reflection_raw.B", "reflection_raw.A"}, 0, K::value,
           "reflected radiance of this frame alone"),
      kind("frames", {""}, {"frames"}, 0, K::value,
           "how many frames have shown the surface since it came into view or changed, less what was new of it; a mean "
           "over time counts as many at most"),
      kind("history", {"r", "g", "b", "a"}, {"history.R", "history.G", "history.B", "history.A"}, 0, K::value,
           "reflected radiance of the frame before", "gloam run --history PREVIOUS.exr"),
      kind("history_ao", {""}, {"history.visibility"}, 1, K::value, "raw ambient occlusion of the frame before",
           "gloam run --history PREVIOUS.exr"),
      kind("history_indirect", {"r", "g", "b"}, {"history_indirect.R", "history_indirect.G", "history_indirect.B"}, 0,
           K::value, "raw indirect light of the frame before", "gloam run --history PREVIOUS.exr"),
      kind("history_depth", {""}, {"history.Z"}, inf, K::view_depth, "depth of the frame before",
           "gloam run --history PREVIOUS.exr"),
      kind("history_frames", {""}, {"history.frames"}, 0, K::value,
           "`frames` of the frame before: how many have shown the surface since it came into view or changed",
           "gloam run --history PREVIOUS.exr"),
      kind("reflection_noise", {""}, {"reflection_noise"}, 0, K::value, "estimated error of a ray-traced reflection"),
      colour("indirect", 0, "light from the surfaces around, irradiance / pi"),
      colour("indirect_raw", 0, "light from the surfaces around before filtering"),
      kind("indirect_noise", {""}, {"indirect_noise"}, 0, K::value, "estimated error of ray-traced indirect light"),
      kind("bounces", {"r", "g", "b"}, {"bounces.R", "bounces.G", "bounces.B"}, 1, K::unit_interval,
           "ambient light with light reflected between surfaces; 1 is open"),
      kind("bounces_noise", {""}, {"bounces_noise"}, 0, K::value, "estimated error of ray-traced bounces"),
      kind("specular_occlusion", {""}, {"specular_occlusion"}, 1, K::unit_interval,
           "open share of the glossy lobe; 1 is open"),
      kind("specular_occlusion_raw", {""}, {"specular_occlusion_raw"}, 1, K::unit_interval,
           "specular occlusion in a pixel's own slices alone, before filtering"),
      kind("lobe_weight", {""}, {"lobe_weight"}, 0, K::value,
           "how much of the directions that a glossy surface reflects to the eye a pixel's slices hold; 1 on average"),
      kind("specular_occlusion_noise", {""}, {"specular_occlusion_noise"}, 0, K::value,
           "estimated error of ray-traced specular occlusion"),
      kind("contact", {""}, {"contact"}, 1, K::unit_interval, "share of a light that arrives; 1 is lit"),
      kind("contact_noise", {""}, {"contact_noise"}, 0, K::value, "estimated error of ray-traced contact shadows"),
      colour("environment", 0, "light of the environment from open directions, irradiance / pi"),
      colour("environment_raw", 0, "light of the environment before filtering"),
      kind("color_noise", {""}, {"color_noise"}, 0, K::value, "estimated error of a picture of ray-traced parts"),
      kind("environment_noise", {""}, {"environment_noise"}, 0, K::value,
           "estimated error of ray-traced environment light"),
      kind("hit", {""}, {"hit.Z"}, 0, K::length, "length of the reflected ray, scene units; 0 where it meets nothing"),
  };
  return kinds;
}

int resolution_in(std::string_view name) {
  const size_t at = name.find('@');
  int resolution = 1;
  if (at != std::string_view::npos) std::from_chars(name.data() + at + 1, name.data() + name.size(), resolution);
  return std::max(resolution, 1);
}

PlaneKind plane_kind(std::string_view name) {
  // At a lower resolution (plan.h) a plane means the same.
  name = name.substr(0, name.find('@'));
  for (const PlaneKind& known : plane_kinds())
    if (known.name == name) return known;
  const std::string own(name);
  if (const std::optional<StackLayer> layer = stack_layer(name)) {
    const StackKind& stack = stack_kind(layer->stack);
    return kind(own, {""}, {layer_name(stack.group, layer->number) + "." + stack.component}, stack.outside,
                stack.meaning, "one layer of several");
  }
  if (is_stack(name)) {
    const StackKind& stack = stack_kind(name);
    return kind(own, {""}, {}, stack.outside, stack.meaning, "all layers of a kind");
  }
  return kind(own, {""}, {own}, 0, PlaneKind::value, "");
}

Plane empty_plane(const std::string& name, const Layout& layout) {
  const PlaneKind kind = plane_kind(name);
  Plane plane{name, {}};
  for (size_t i = 0; i < kind.components.size(); ++i) plane.channels.emplace_back(layout, kind.outside);
  return plane;
}

const std::vector<StackKind>& stack_kinds() {
  static const std::vector<StackKind> kinds = [] {
    std::vector<StackKind> all = {
        {"peel", "peel", "Z", "all surfaces under the pixel centre, front to back", "gloam capture --peel N", inf,
         PlaneKind::view_depth},
        {"stochastic", "stochastic", "Z", "stochastic depth: each layer is the nearest of a random choice of surfaces",
         "gloam capture --stochastic S", inf, PlaneKind::view_depth},
    };
    const char* const source = "gloam capture --peel N --peel-light";
    for (const char* component : {"R", "G", "B"})
      all.push_back({std::string("peel_color_") + char(std::tolower(*component)), "peel_color", component,
                     "scene-linear radiance of the surfaces under the pixel centre, on the side of peel_normal", source,
                     0, PlaneKind::value});
    for (const char* component : {"X", "Y", "Z"})
      all.push_back({std::string("peel_normal_") + char(std::tolower(*component)), "peel_normal", component,
                     "normals of the surfaces under the pixel centre, view space; of a hidden back face on the side "
                     "away from the eye",
                     source, 0, PlaneKind::value});
    return all;
  }();
  return kinds;
}

bool is_stack(std::string_view name) {
  return std::any_of(stack_kinds().begin(), stack_kinds().end(),
                     [&](const StackKind& stack) { return stack.name == name; });
}

const StackKind& stack_kind(std::string_view name) {
  for (const StackKind& stack : stack_kinds())
    if (stack.name == name) return stack;
  throw std::out_of_range(fmt::format("'{}' is no stack", name));
}

namespace {

/// The name before ".NN", and the number.
std::optional<StackLayer> numbered(std::string_view name) {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  const std::string_view number = name.substr(dot + 1);
  if (number.size() != 2 || !is_digit(number[0]) || !is_digit(number[1])) return {};
  return StackLayer{std::string(name.substr(0, dot)), 10 * (number[0] - '0') + (number[1] - '0')};
}

bool is_lower_case_of(std::string_view lower, std::string_view text) {
  return std::equal(lower.begin(), lower.end(), text.begin(), text.end(),
                    [](char a, char b) { return a == char(std::tolower(static_cast<unsigned char>(b))); });
}

}  // namespace

std::vector<std::string> all_plane_names(int layers) {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) names.push_back(kind.name);
  for (const StackKind& stack : stack_kinds()) {
    for (int layer = 0; layer < layers; ++layer) names.push_back(layer_name(stack.name, layer));
  }
  return names;
}

std::optional<StackLayer> stack_layer(std::string_view plane) {
  std::optional<StackLayer> layer = numbered(plane);
  if (layer && !is_stack(layer->stack)) layer.reset();
  return layer;
}

std::string plane_of_layer(std::string_view path, std::string_view component) {
  const std::optional<StackLayer> layer = numbered(path);
  if (!layer) return "";
  for (const StackKind& stack : stack_kinds()) {
    if (stack.group == layer->stack && is_lower_case_of(component, stack.component))
      return layer_name(stack.name, layer->number);
  }
  return "";
}

std::string layer_name(const std::string& stack, int number) { return fmt::format("{}.{:02}", stack, number); }

}  // namespace gloam
