#include "scene/capture_target.h"

#include <iterator>
#include <limits>
#include <string>

#include "base/lists.h"
#include "gloam/planes.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

Channel* add_channel(View& view, const std::string& name, const Layout& layout) {
  Plane& plane = view.planes.emplace(name, empty_plane(name, layout)).first->second;
  return &plane.channels.front();
}

}  // namespace

CaptureTarget capture_target(View& view, const CaptureOptions& options, const Layout& layout) {
  CaptureTarget target;
  const auto single = [&](const char* name, Channel*& channel) {
    if (contains(options.planes, std::string(name))) channel = add_channel(view, name, layout);
  };
  const auto several = [&](const char* name, auto& channels) {
    if (!contains(options.planes, std::string(name))) return;
    Channel* first = add_channel(view, name, layout);
    for (size_t i = 0; i < std::size(channels); ++i) channels[i] = first + i;
  };
  target.depth = add_channel(view, "depth", layout);
  several("normal", target.normal);
  several("albedo", target.albedo);
  several("color", target.color);
  several("ambient", target.ambient);
  several("emission", target.emission);
  several("reflectance", target.reflectance);
  several("position", target.position);
  several("motion", target.motion);
  single("roughness", target.roughness);
  single("metallic", target.metallic);
  single("back_depth", target.back_depth);
  single("instance", target.instance);
  target.has_material = target.albedo[0] || target.color[0] || target.ambient[0] || target.emission[0] ||
                        target.reflectance[0] || target.roughness || target.metallic;
  if (options.peel > 0) target.peel_count = add_channel(view, "peel_count", layout);
  if (options.outlines) target.outline_count = add_channel(view, "outline_count", layout);
  for (int i = 0; i < options.peel; ++i) target.peel.push_back(add_channel(view, layer_name("peel", i), layout));
  const auto layer_of = [&](const std::string& plane, int number) {
    std::array<Channel*, 3> channels;
    const char* const components = plane == "peel_color" ? "rgb" : "xyz";
    for (size_t i = 0; i < 3; ++i)
      channels[i] = add_channel(view, layer_name(plane + "_" + components[i], number), layout);
    return channels;
  };
  for (int i = 0; options.peel_light && i < options.peel; ++i) {
    target.peel_color.push_back(layer_of("peel_color", i));
    target.peel_normal.push_back(layer_of("peel_normal", i));
  }
  for (int i = 0; i < options.stochastic.samples; ++i)
    target.stochastic.push_back(add_channel(view, layer_name("stochastic", i), layout));
  return target;
}

double far_of(const Camera& camera) { return camera.far.value_or(std::numeric_limits<double>::infinity()); }

bool shows(const Camera& camera, int x, int y) {
  return !camera.slits || view_ray(camera, {x + 0.5, y + 0.5}).has_value();
}

}  // namespace gloam
