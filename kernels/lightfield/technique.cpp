#include <array>
#include <cmath>
#include <numbers>

#include "estimators/obscurance_params.h"
#include "shared/sampling/ambient_occlusion.h"
#include "shared/sampling/mask_params.h"
#include "technique/ambient_occlusion.h"
#include "technique/cell_masks.h"
#include "technique/point_sets.h"

#define REUSE_PARAMS(P, from)                                                                               \
  P(bool, reuse, off, "reuse the AO of key views for points that they show too, and compute only the rest") \
  P(int, key_views, 4, 2, 64, "views", "distance between key views, which are computed in full")            \
  P(choice, reuse_from, from, (both, nearest),                                                              \
    "where both neighbouring key views show a point: their mean, or the nearest's value")                   \
  P(float, back_check, 1, 0.5f, 16, "pixels", "a key view shows the same point if it projects back this close")

#define LIGHTFIELD_SSAO_PARAMS(P)                                                                                    \
  REACH_PARAMS(P)                                                                                                    \
  P(int, samples, 8, 1, 256, "", "points looked at per pixel and radius")                                            \
  P(int, radii, 5, 1, 8, "", "balls, each `ratio` times as large as the one before; the lowest AO counts")           \
  P(float, ratio, 0.5f, 0.1f, 0.95f, "", "ratio of a radius to the one before")                                      \
  P(choice, points, spiral, (spiral, random, jittered, latin_square, poisson_disk),                                  \
    "how the points are spread; all but the spiral are other points for each pixel and seed")                        \
  P(bool, hemisphere, on, "points in the half ball above the surface; off: in the whole ball, as in the paper")      \
  P(float, inner, 0, 0, 0.99f, "radii", "least distance of the points: a shell instead of a ball; 0.8 in the paper") \
  P(float, bias, 0.02f, 0, 0.99f, "",                                                                                \
    "slope above the surface up to which a visible surface occludes no point of the half ball")                      \
  P(float, range, 2, 0, INFINITY, "radii",                                                                           \
    "an occluder up to this far before the pixel's point counts in full, from twice that on not at all")             \
  REUSE_PARAMS(P, both)

#define LIGHTFIELD_HBAO_PLUS_PARAMS(P) \
  REACH_PARAMS(P)                      \
  OBSCURANCE_SEARCH_PARAMS(P)          \
  OBSCURANCE_FALLOFF(P)                \
  REUSE_PARAMS(P, nearest)

#define LIGHTFIELD_MASK_PARAMS(P) \
  REACH_PARAMS(P)                 \
  MASK_SEARCH_PARAMS(P)           \
  MASK_CELL(P)

PARAMS(LightfieldMaskParams, LIGHTFIELD_MASK_PARAMS)
PARAMS(LightfieldSsaoParams, LIGHTFIELD_SSAO_PARAMS)
PARAMS(LightfieldHbaoPlusParams, LIGHTFIELD_HBAO_PLUS_PARAMS)

namespace gloam::techniques {
namespace {

using Points = LightfieldSsaoParams::points_values;

/// Points as in `ssao` (shared/sampling/ball.h): a Fibonacci spiral, and distances by a second sequence. Further radii go
/// on with both.
glm::dvec3 of_spiral(int k, int radius, int samples) {
  constexpr double golden_turns = 0.38196601125010515;
  constexpr uint32_t distance_step = 0xbb67ae85u;
  const uint32_t number = uint32_t(k + radius * samples);
  const double turns = number * golden_turns;
  return {(k + 0.5) / samples, turns - std::floor(turns), ((number * distance_step) >> 8) * 0x1p-24};
}

std::vector<glm::dvec3> points_of(const LightfieldSsaoParams& p, int radius) {
  if (p.points != Points::spiral) {
    const PointSet set[] = {PointSet::random, PointSet::random, PointSet::jittered, PointSet::latin_square,
                            PointSet::poisson_disk};
    return point_set(set[p.points], p.samples, uint32_t(radius));
  }
  std::vector<glm::dvec3> points;
  for (int k = 0; k < p.samples; ++k) points.push_back(of_spiral(k, radius, p.samples));
  return points;
}

/// What the kernel turns into a point (lightfield/points.h). The spiral of the whole ball begins at its top, as in `ssao`.
std::array<double, 4> entry_of(const LightfieldSsaoParams& p, const glm::dvec3& point) {
  if (p.points != Points::spiral) return {point.x, point.y, 0, point.z};
  const double axis = p.hemisphere ? point.x : 1 - 2 * point.x, sine = std::sqrt(1 - axis * axis);
  const double angle = 2 * std::numbers::pi * point.y;
  return {sine * std::cos(angle), sine * std::sin(angle), axis, point.z};
}

std::vector<float> table_of(const LightfieldSsaoParams& p) {
  std::vector<float> table;
  for (int radius = 0; radius < p.radii; ++radius) {
    for (const glm::dvec3& point : points_of(p, radius)) {
      for (const double value : entry_of(p, point)) table.push_back(float(value));
    }
  }
  return table;
}

/// With --set reuse=on: estimates key views, and on the other views only what the key views do not show. A mask does not reduce the
/// work on a key view, since other views may reuse any of its pixels.
template <typename Params>
std::vector<Pass> with_reuse(Pass estimate, const Params& p) {
  estimate.reads.push_back("position");
  estimate.projects = true;
  estimate.defines.emplace_back("REUSE", p.reuse);
  if (!p.reuse) return {estimate};
  Pass reuse{.name = "reuse",
             .kernel = "lightfield_reuse",
             .reads = {"depth", "position"},
             .writes = {"ao_raw", starts_empty("newly_visible")},
             .defines = estimate.defines,
             .on = On::views_between,
             .can_skip = true,
             .projects = true};
  Pass key{.name = "key",
           .kernel = "lightfield_key",
           .reads = {"ao_of_key"},
           .writes = {"ao_raw"},
           .defines = estimate.defines,
           .on = On::key_views,
           .can_skip = true};
  reuse.defines.emplace_back("FROM_BOTH", p.reuse_from == Params::reuse_from_values::both);
  for (const auto& [prefix, view] : {std::pair{"key_", From::nearest_key_view}, {"far_", From::further_key_view}}) {
    for (const auto& [argument, plane] : {std::pair{"depth", "depth"}, {"position", "position"}, {"ao", "ao_of_key"}})
      reuse.reads.push_back(from(view, {std::string(prefix) + argument, plane}));
  }
  Pass rest = estimate;
  rest.name = "newly visible";
  rest.kernel += "_list";
  rest.reads.push_back("newly_visible");
  rest.footprint = {};
  rest.can_skip = false;
  rest.on = On::views_between;
  estimate.on = On::key_views;
  estimate.writes = {{"ao_raw", "ao_of_key"}};
  estimate.can_skip = false;
  return {estimate, key, reuse, rest};
}

std::vector<Pass> ssao_passes(const LightfieldSsaoParams& p) {
  Pass estimate = ambient_occlusion_estimate(p, "lightfield_estimate",
                                             {{"ESTIMATE", 1},
                                              {"SAMPLES", p.samples},
                                              {"RADII", p.radii},
                                              {"HEMISPHERE", p.hemisphere},
                                              {"OWN_POINTS", p.points != Points::spiral},
                                              {"SINGLE_POINTS", p.points == Points::random}});
  estimate.tables = {{"points", table_of(p)}};
  return with_reuse(std::move(estimate), p);
}

std::vector<Pass> hbao_plus_passes(const LightfieldHbaoPlusParams& p) {
  return with_reuse(
      ambient_occlusion_estimate(p, "lightfield_estimate",
                                 {{"ESTIMATE", 2},
                                  {"DIRECTIONS", p.directions},
                                  {"STEPS", p.steps},
                                  {"NO_FALLOFF", p.falloff == LightfieldHbaoPlusParams::falloff_values::none}}),
      p);
}

int key_views(const ParameterValues& values) {
  return values.number("reuse") != 0 ? int(values.number("key_views")) : 1;
}

Technique through_projection(std::string name, std::string summary) {
  Technique t = ambient_occlusion(std::move(name), std::move(summary), "Doronin, Kara, Barsi, Martini 2017",
                                  "lightfield/lightfield.cl");
  t.reads.push_back("position");
  t.any_projection = true;
  t.key_views = key_views;
  t.then = "gaussian";
  t.then_with = {{"sigma", "1"}, {"half_width", "2"}};
  return t;
}

Technique ssao() {
  Technique t = through_projection(
      "lightfield-ssao",
      "ambient occlusion through any projection: points in balls of several radii, for light-field displays");
  t.parameters = LightfieldSsaoParams::table();
  t.presets = {{"low", {{"samples", "4"}}},
               {"medium", {{"samples", "8"}}},
               {"high", {{"samples", "16"}}},
               {"ultra", {{"samples", "32"}}}};
  t.converged = {{"samples", "256"}};
  t.passes = passes_of(ssao_passes);
  t.samples = [](const ParameterValues& values) { return int(values.number("samples") * values.number("radii")); };
  return t;
}

Technique hbao_plus() {
  Technique t = through_projection("lightfield-hbao+",
                                   "ambient occlusion through any projection: mean obscurance over directions x steps");
  t.paper += "; NVIDIA 2016";
  t.parameters = LightfieldHbaoPlusParams::table();
  t.presets = {{"low", {{"directions", "4"}, {"steps", "2"}}},
               {"medium", {{"directions", "6"}, {"steps", "3"}}},
               {"high", {{"directions", "8"}, {"steps", "4"}}},
               {"ultra", {{"directions", "12"}, {"steps", "6"}}}};
  t.converged = {{"directions", "32"}, {"steps", "32"}};
  t.passes = passes_of(hbao_plus_passes);
  t.samples = directions_times_steps;
  return t;
}

std::vector<Pass> mask_passes(const LightfieldMaskParams& p) {
  const Defines defines = {{"ESTIMATE", 3},
                           {"SCALE", p.cell},
                           {"DIRECTIONS", p.search_directions},
                           {"STEPS", p.search_steps},
                           {"JITTER", p.jitter},
                           {"OUTSIDE_OPEN", p.outside == LightfieldMaskParams::outside_values::open}};
  Pass subsample{
      .name = "subsample",
      .kernel = "lightfield_subsample",
      .reads = {"depth", "normal", "position"},
      .writes = {{"low_depth", "depth@cells"}, {"low_normal", "normal@cells"}, {"low_position", "position@cells"}},
      .defines = defines,
      .scale = p.cell};
  Pass find{.name = "find",
            .kernel = "lightfield_find",
            .reads = {{"depth", "depth@cells"}, {"normal", "normal@cells"}, {"position", "position@cells"}},
            .writes = {{"found", "corners"}},
            .defines = defines,
            .scale = p.cell,
            .footprint = {.is_wide = true},
            .projects = true};
  return mask_of_cells({std::move(subsample), std::move(find)});
}

Technique mask() {
  return {.name = "lightfield-mask",
          .summary = "where something within the radius may occlude, through any projection",
          .paper = "after OdSSAO 2020, for Doronin, Kara, Barsi, Martini 2017",
          .source = "lightfield/lightfield.cl",
          .reads = {"depth", "normal", "position"},
          .writes = {"mask"},
          .any_projection = true,
          .parameters = LightfieldMaskParams::table(),
          .passes = passes_of(mask_passes)};
}

/// No mask: key views do not use one, and the other views compute little. If anything occludes, the whole image is computed.
Effect effect_of_displays() {
  return {.name = "ambient occlusion",
          .changes = "ao",
          .for_displays = true,
          .mask = "lightfield-mask",
          .probe = {{"cell", "8"}, {"search_steps", "2"}},
          .most_share = 0,
          .settings = {{"reuse", "on"}},
          .somewhere = "something rises over the surface within the radius",
          .nowhere = "nothing rises over any surface within the radius"};
}

}  // namespace

std::vector<Technique> lightfield() {
  Technique of_displays = ssao();
  of_displays.effect = effect_of_displays();
  return {std::move(of_displays), hbao_plus(), mask()};
}

}  // namespace gloam::techniques
