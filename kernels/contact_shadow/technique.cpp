#include "gloam/technique.h"

#include <glm/geometric.hpp>

#include "contact_shadow/params.h"
#include "gloam/error.h"

namespace gloam::techniques {
namespace {

constexpr const char* another_light = "--light directional --light_x X --light_y Y --light_z Z takes it from elsewhere";

template <typename Params>
bool is_sun(const Params& p) {
  return p.light == Params::light_values::sun;
}

template <typename Params>
bool is_point(const Params& p) {
  return p.light == Params::light_values::point;
}

template <typename Params>
bool is_in_world(const Params& p, const View& view) {
  return p.light_in == Params::light_in_values::world ||
         (p.light_in == Params::light_in_values::known && view.camera->pose);
}

/// The name of the first coordinate of the light that is not 0; empty if all are 0.
template <typename Params>
std::string given_coordinate(const Params& p) {
  return p.light_x != 0 ? "light_x" : p.light_y != 0 ? "light_y" : p.light_z != 0 ? "light_z" : "";
}

template <typename Params>
void check_light(const Params& p) {
  const std::string given = given_coordinate(p);
  if (is_sun(p) && !given.empty())
    throw UsageError("{} is of no use with light sun; set light to directional or point", given);
  if (p.light == Params::light_values::directional && given.empty())
    throw UsageError("light_x, light_y and light_z are all 0, which is no direction; one that is not 0 is allowed");
}

/// The unit direction towards the light, or with `is_point` its place, in the view's space.
template <typename Params>
glm::dvec3 light_in_view(const Params& p, const View& view) {
  const bool in_world = is_in_world(p, view);
  if (in_world && !view.camera->pose)
    throw Error(
        "light_in world needs the pose of the camera, which is unknown; give the pose by --camera, or set light_in to "
        "view");
  glm::dvec3 light(p.light_x, p.light_y, p.light_z);
  if (is_sun(p)) light = in_world && view.light ? *view.light : glm::dvec3(0, 1, 0);
  if (in_world) {
    const Pose& pose = *view.camera->pose;
    light = pose.world_to_view * (is_point(p) ? light - pose.position : light);
  }
  return is_point(p) ? light : glm::normalize(light);
}

template <typename Params>
std::vector<float> table_of(const Params& p, const View& view) {
  const glm::dvec3 light = light_in_view(p, view);
  return {float(light.x), float(light.y), float(light.z)};
}

/// What is taken for the light where the frame leaves it open.
template <typename Params>
std::string assumption(const ParameterValues& values, const View& view) {
  const Params p = values.as<Params>();
  const bool in_world = is_in_world(p, view);
  if (is_sun(p) && in_world && !view.light)
    return fmt::format(
        "light: the frame states no sun (gloamLight), so light comes from straight up, 0,1,0 in the world; {}",
        another_light);
  if (is_sun(p) && !in_world)
    return fmt::format("light: {}, so light comes from straight up in the image, 0,1,0 in view space; {}",
                       view.camera->pose ? "light_in is view" : "the pose of the camera is unknown", another_light);
  if (!in_world && p.light_in == Params::light_in_values::known)
    return "light: the pose of the camera is unknown, so light_x, light_y and light_z are in view space";
  return "";
}

template <typename Params>
Pass with_light(Pass pass, const Params& p) {
  pass.defines.insert(pass.defines.end(), {{"POINT", is_point(p)}, {"JITTER", p.jitter}});
  pass.view_tables = {{"light", [p](const View& view) { return table_of(p, view); }}};
  return pass;
}

std::vector<Pass> shadow_passes(const ContactShadowParams& p) {
  check_light(p);
  return {with_light({.name = "march",
                      .kernel = "contact_shadow",
                      .reads = {"depth", "normal"},
                      .writes = {"contact"},
                      .defines = {{"STEPS", p.steps}},
                      .footprint = {.is_wide = true},
                      .can_skip = true},
                     p)};
}

Technique shadow() {
  Technique t;
  t.name = "contact-shadow";
  t.summary = "shadows of what is near a surface, between the surface and one light";
  t.paper = "after McGuire, Mara 2014";
  t.source = "contact_shadow/contact_shadow.cl";
  t.reads = {"depth", "normal"};
  t.writes = {"contact"};
  t.default_for = {"contact"};
  t.parameters = ContactShadowParams::table();
  t.presets = {{"low", {{"steps", "8"}}},
               {"medium", {{"steps", "16"}}},
               {"high", {{"steps", "32"}}},
               {"ultra", {{"steps", "64"}}}};
  t.converged = {{"steps", "1024"}};
  t.passes = passes_of(shadow_passes);
  t.assumes = assumption<ContactShadowParams>;
  t.samples = [](const ParameterValues& values) { return int(values.number("steps")); };
  return t;
}

}  // namespace

std::vector<Technique> contact_shadow() { return {shadow()}; }

}  // namespace gloam::techniques
