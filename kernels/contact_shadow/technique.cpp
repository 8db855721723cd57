#include "gloam/technique.h"

#include <glm/geometric.hpp>

#include "gloam/error.h"
#include "gloam/projection.h"
#include "shared/both/params.h"
#include "technique/cell_masks.h"

// The light, and how far it is followed.
#define CONTACT_LIGHT_PARAMS(P)                                                                                       \
  P(float, length, 0.5f, 0, INFINITY, "scene units", "distance from the surface up to which something shades it")     \
  P(float, max_reach, 0.25f, 0, 1, "image widths", "cap on the length on the screen")                                 \
  P(float, thickness, 0.4f, 0, INFINITY, "lengths", "how far an occluder reaches behind its visible front")           \
  P(choice, light, sun, (sun, directional, point), "sun: as the frame states it (gloamLight), else from straight up") \
  P(float, light_x, 0, -1e30f, 1e30f, "",                                                                             \
    "direction towards a directional light; place of a point light, scene units")                                     \
  P(float, light_y, 1, -1e30f, 1e30f, "", "likewise")                                                                 \
  P(float, light_z, 0, -1e30f, 1e30f, "", "likewise")                                                                 \
  P(choice, light_in, world, (world, view),                                                                           \
    "space of light_x, light_y and light_z; of a camera without a pose only view space is known")

#define CONTACT_SHADOW_PARAMS(P)                               \
  CONTACT_LIGHT_PARAMS(P)                                      \
  P(int, steps, 16, 1, 1024, "", "samples towards the light")  \
  P(bool, jitter, on, "shift the samples from pixel to pixel") \
  P(float, bias, 0.01f, 0, 1, "", "what rises over the tangent plane by a lower sine does not count")

#define CONTACT_MASK_PARAMS(P)                                                                           \
  CONTACT_LIGHT_PARAMS(P)                                                                                \
  P(int, search_steps, 16, 1, 64, "", "samples towards the light from the pixel that stands for a cell") \
  P(float, least_sine, 0.01f, 0.00048828125f, 1, "",                                                     \
    "something may shade if it rises over the tangent plane by at least this sine")                      \
  P(int, cell, 4, 2, 16, "pixels", "width and height of a cell of the mask")

PARAMS(ContactShadowParams, CONTACT_SHADOW_PARAMS)
PARAMS(ContactMaskParams, CONTACT_MASK_PARAMS)

namespace gloam::techniques {
namespace {

constexpr const char* another_light = "set light to directional for another";

/// Where the sun is if nothing states it; the defaults of light_x, light_y and light_z.
const glm::dvec3 up(0, 1, 0);

template <typename Params>
bool is_sun(const Params& p) {
  return p.light == Params::light_values::sun;
}

template <typename Params>
bool is_point(const Params& p) {
  return p.light == Params::light_values::point;
}

/// Where the pose is unknown, what is meant in the world is taken for view space (`assumption` says so).
template <typename Params>
bool is_in_world(const Params& p, const View& view) {
  return p.light_in == Params::light_in_values::world && view.camera->pose;
}

template <typename Params>
glm::dvec3 given_light(const Params& p) {
  return {p.light_x, p.light_y, p.light_z};
}

template <typename Params>
void check_light(const Params& p) {
  if (p.light == Params::light_values::directional && given_light(p) == glm::dvec3(0))
    throw UsageError("light_x, light_y and light_z are all 0, which is no direction; one of them must not be 0");
}

/// The unit direction towards the light, or with `is_point` its place, in the view's space.
template <typename Params>
glm::dvec3 light_in_view(const Params& p, const View& view) {
  const bool in_world = is_in_world(p, view);
  glm::dvec3 light = given_light(p);
  if (is_sun(p)) light = in_world && view.light ? *view.light : up;
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

/// How far a point light lies behind the surface that the view shows there, where occluders reach that far: in them, for the
/// shadows. 0: it lies in none.
template <typename Params>
double depth_inside(const Params& p, const View& view) {
  const Plane* depth = view.find("depth");
  if (!is_point(p) || !depth) return 0;
  const glm::dvec3 light = light_in_view(p, view);
  const std::optional<glm::dvec2> place = pixel_of(*view.camera, light);
  const Layout& layout = depth->channels.front().layout();
  if (!place || !(place->x >= 0 && place->y >= 0 && place->x < layout.width && place->y < layout.height)) return 0;
  const double behind = -light.z - double(depth->channels.front().at(int(place->x), int(place->y)));
  return behind > 0 && behind <= p.thickness * p.length ? behind : 0;
}

/// What is taken for the light where the frame leaves it open, or settings have no effect.
template <typename Params>
std::string assumption(const ParameterValues& values, const View& view) {
  const Params p = values.as<Params>();
  const bool in_world = is_in_world(p, view);
  const char* const without_pose = "the pose of the camera is unknown";
  if (is_sun(p) && given_light(p) != up)
    return "light: light_x, light_y and light_z have no effect with light sun; set light to directional or point";
  if (is_sun(p) && in_world && !view.light)
    return fmt::format("light: the frame states no sun (gloamLight), so light comes from 0,1,0 in the world; {}",
                       another_light);
  if (is_sun(p) && !in_world)
    return fmt::format("light: {}, so light comes from 0,1,0 in view space; {}",
                       view.camera->pose ? "light_in is view" : without_pose, another_light);
  if (!in_world && p.light_in == Params::light_in_values::world)
    return fmt::format("light: {}, so light_x, light_y and light_z are taken for view space", without_pose);
  if (const double inside = depth_inside(p, view); inside > 0)
    return fmt::format(
        "light: {},{},{} lies {:.3g} scene units behind the surface that the frame shows there, inside of it if it is "
        "as thick as "
        "thickness says ({} lengths of {:g}): all within a length of the light is in its shadow; move the light, or "
        "lower thickness",
        p.light_x, p.light_y, p.light_z, inside, p.thickness, p.length);
  return "";
}

template <typename Params>
Pass with_light(Pass pass, const Params& p) {
  pass.defines.push_back({"POINT", is_point(p)});
  pass.view_tables = {{"light", [p](const View& view) { return table_of(p, view); }}};
  return pass;
}

std::vector<Pass> shadow_passes(const ContactShadowParams& p) {
  check_light(p);
  return {with_light({.name = "march",
                      .kernel = "contact_shadow",
                      .reads = {"depth", "normal"},
                      .writes = {"contact"},
                      .defines = {{"STEPS", p.steps}, {"JITTER", p.jitter}},
                      .footprint = {.is_wide = true},
                      .can_skip = true},
                     p)};
}

std::vector<Pass> mask_passes(const ContactMaskParams& p) {
  check_light(p);
  const Defines defines = {{"SCALE", p.cell}, {"STEPS", p.search_steps}};
  Pass subsample{.name = "subsample",
                 .kernel = "contact_subsample",
                 .reads = {"depth", "normal"},
                 .writes = {{"low_depth", "depth@cells"}, {"low_normal", "normal@cells"}},
                 .defines = defines,
                 .scale = p.cell};
  Pass find{.name = "find",
            .kernel = "contact_find",
            .reads = {{"depth", "depth@cells"}, {"normal", "normal@cells"}},
            .writes = {{"found", "contacts"}},
            .defines = defines,
            .scale = p.cell,
            .footprint = {.is_wide = true}};
  find = with_light(std::move(find), p);
  subsample.defines = find.defines;
  return mask_of_cells({std::move(subsample), std::move(find)});
}

Technique mask() {
  Technique t;
  t.name = "contact-mask";
  t.summary = "where contact shadows can be, from depth and normals alone";
  t.paper = "after OdSSAO 2020";
  t.source = "contact_shadow/contact_mask.cl";
  t.reads = {"depth", "normal"};
  t.writes = {"mask"};
  t.parameters = ContactMaskParams::table();
  t.passes = passes_of(mask_passes);
  t.assumes = assumption<ContactMaskParams>;
  return t;
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
  t.effect = {.name = "contact shadows",
              .changes = "contact",
              .mask = "contact-mask",
              .probe = {{"cell", "8"}, {"search_steps", "2"}},
              .most_share = 0.7,
              .least_change = 0.01,
              .somewhere = "something near stands before the light",
              .nowhere = "nothing near stands before the light"};
  return t;
}

}  // namespace

std::vector<Technique> contact_shadow() { return {shadow(), mask()}; }

}  // namespace gloam::techniques
