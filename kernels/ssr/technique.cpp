#include "gloam/technique.h"

#include <algorithm>

#include "shared/both/params.h"
#include "shared/rays/environment_params.h"
#include "technique/environment_light.h"

// How a ray is followed.
#define RAY_PARAMS(P)                                                                                                 \
  P(choice, march, hierarchical, (hierarchical, linear),                                                              \
    "how a ray is followed: through cells that hold their nearest depth, or from pixel to pixel; both find the same " \
    "but for rounding")                                                                                               \
  P(choice, cells, min_max, (min_max, min),                                                                           \
    "what a cell holds: its nearest and its farthest depth, so that rays also pass behind surfaces in few steps, or " \
    "only the nearest")                                                                                               \
  P(int, max_steps, 1024, 1, 65536, "", "cells or pixels that a ray visits before it counts as a miss")               \
  P(float, thickness, 0.02f, 0, INFINITY, "depths", "how far a surface reaches behind its visible front")             \
  P(float, bias, 0.01f, 0, 1, "", "a hit counts as the surface itself below this sine of the angle to it")            \
  P(float, max_roughness, 0.8f, 0, 1, "", "surfaces rougher than this have no rays of their own")                     \
  P(float, max_distance, INFINITY, 0, INFINITY, "scene units", "longest ray; over its last quarter hits fade")

#define SSSR_PARAMS(P)                                                                                            \
  P(int, rays, 1, 1, 4, "", "rays per pixel")                                                                     \
  RAY_PARAMS(P)                                                                                                   \
  P(int, neighbours, 21, 1, 25, "pixels",                                                                         \
    "pixels whose rays each pixel uses, itself included, at most 2 columns or rows away")                         \
  P(float, fade_border, 0.05f, 0, 0.5f, "image sizes", "hits nearer to the border of the image than this fade")   \
  P(float, fade_facing, 0.9f, 0, 1, "", "rays back towards the eye fade from this cosine to the viewing axis on") \
  P(float, environment_r, 0, 0, 1e20f, "", "radiance where a ray finds no hit, red")                              \
  P(float, environment_g, 0, 0, 1e20f, "", "radiance where a ray finds no hit, green")                            \
  P(float, environment_b, 0, 0, 1e20f, "", "radiance where a ray finds no hit, blue")                             \
  ENVIRONMENT_PARAMS(P, "environment_r, _g, _b from everywhere")                                                  \
  P(bool, jitter, on, "vary the rays from pixel to pixel")

#define STEREO_SSR_PARAMS(P)                                                                                       \
  SSSR_PARAMS(P)                                                                                                   \
  P(choice, traversal, stereo, (stereo, mono),                                                                     \
    "a ray that leaves the image or passes behind a surface goes on in the other eye's image (stereo) or ends")    \
  P(choice, fade, stereo, (stereo, mono),                                                                          \
    "hits fade near the border of the eye's image that shows them nearer to its middle, or of the one that found " \
    "them")                                                                                                        \
  P(bool, reprojection, on, "use the other eye's rays that show the same virtual image")                           \
  P(int, other_neighbours, 21, 1, 25, "pixels", "pixels of the other eye whose rays each pixel uses")

#define TEMPORAL_SSSR_PARAMS(P)                                                                                     \
  SSSR_PARAMS(P)                                                                                                    \
  P(int, most_frames, 16, 1, 1024, "frames", "most frames in a pixel's mean; then the oldest fade")                 \
  P(float, same_depth, 0.05f, 0, INFINITY, "", "share by which a surface's depth may differ from the frame before") \
  P(float, kept_within, 3, 0, 1e6f, "mean deviations",                                                              \
    "how far the value from the frame before may be from the neighbours' mean; it is clamped to that")

#define REFLECTION_MASK_PARAMS(P) \
  RAY_PARAMS(P)                   \
  P(float, blurred, 0.2f, 0, 1, "", "from this roughness on, one direction does not tell what a surface reflects")

PARAMS(SssrParams, SSSR_PARAMS)
PARAMS(StereoSsrParams, STEREO_SSR_PARAMS)
PARAMS(TemporalSssrParams, TEMPORAL_SSSR_PARAMS)
PARAMS(ReflectionMaskParams, REFLECTION_MASK_PARAMS)

namespace gloam::techniques {
namespace {

using Bindings = std::vector<Binding>;

/// Levels of the hierarchy: the largest cells have 64 x 64 pixels.
constexpr int hierarchy_levels = 7;

/// The parameters of all variants that shape passes.
struct Choices {
  int rays = 1, neighbours = 0;
  bool jitter = false;
  bool traversal = false, fade = false, reprojection = false;  ///< what is used of the other eye
  int other_neighbours = 0;
  bool accumulates = false;  ///< over frames
};

Choices choices_of(const SssrParams& p) {
  return {.rays = p.rays, .neighbours = p.neighbours, .jitter = p.jitter != 0};
}

Choices choices_of(const TemporalSssrParams& p) {
  return {.rays = p.rays, .neighbours = p.neighbours, .jitter = p.jitter != 0, .accumulates = true};
}

Choices choices_of(const StereoSsrParams& p) {
  return {.rays = p.rays,
          .neighbours = p.neighbours,
          .jitter = p.jitter != 0,
          .traversal = p.traversal == StereoSsrParams::traversal_values::stereo,
          .fade = p.fade == StereoSsrParams::fade_values::stereo,
          .reprojection = p.reprojection != 0,
          .other_neighbours = p.other_neighbours};
}

Choices choices_of(const ReflectionMaskParams&) { return {}; }

Bindings operator+(Bindings a, const Bindings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// These planes of the other eye: "other_depth".
Bindings of_other_eye(const Bindings& planes) {
  Bindings bindings;
  for (const Binding& plane : planes)
    bindings.push_back(from(From::other_view, {"other_" + plane.argument, plane.plane, plane.layers}));
  return bindings;
}

/// The passes for given parameters, of one eye or of two.
template <typename Params>
class Passes {
 public:
  explicit Passes(const Params& p) : p_(p), c_(choices_of(p)) {}

  /// The passes of reflection-mask: mirror rays alone.
  std::vector<Pass> mask() const {
    std::vector<Pass> passes = until_met();
    passes.push_back({.name = "found",
                      .kernel = "ssr_found",
                      .source = "ssr/found.cl",
                      .reads = Bindings{"roughness"} + of_rays({"ray_density"}) + met(),
                      .writes = {{"found", "mask"}}});
    return with_defines(std::move(passes));
  }

  std::vector<Pass> all() const {
    std::vector<Pass> passes = until_met();
    if (c_.traversal) passes.push_back(march_in_other());
    passes.push_back(see());
    passes.push_back(resolve());
    if (c_.accumulates) passes.push_back(accumulate());
    return with_defines(std::move(passes));
  }

 private:
  bool is_linear() const { return p_.march == Params::march_values::linear; }
  bool has_both_depths() const { return !is_linear() && p_.cells == Params::cells_values::min_max; }
  int levels() const { return is_linear() ? 1 : hierarchy_levels; }

  /// A stack with one layer for each of a pixel's rays.
  Binding plane_of_rays(const std::string& name) const { return {name, "ssr_" + name, c_.rays}; }
  Bindings of_rays(const std::vector<std::string>& names) const {
    Bindings bindings;
    for (const std::string& name : names) bindings.push_back(plane_of_rays(name));
    return bindings;
  }

  // As screen_ray.h has them.
  Binding levels_in(const std::string& name) const {
    Binding stack{name, "ssr_" + name, 2};
    if (!is_linear()) stack.more_rows = 16 * levels();
    return stack;
  }
  Binding nearness() const { return levels_in("nearness"); }
  Binding farness() const { return levels_in("farness"); }
  Bindings cells(bool with_both_depths) const {
    return with_both_depths ? Bindings{nearness(), farness()} : Bindings{nearness()};
  }

  Bindings reflector() const { return {"depth", "normal", "roughness", "reflectance"}; }
  Bindings image() const { return {"depth", "normal", "color"}; }
  Bindings list() const { return {plane_of_rays("list")}; }
  Bindings directions() const { return of_rays({"ray_x", "ray_y", "ray_z"}); }
  Bindings rays() const { return directions() + of_rays({"ray_density"}); }
  Bindings met() const { return c_.traversal ? of_rays({"met", "met_in_other"}) : of_rays({"met"}); }
  Bindings seen() const { return of_rays({"ray_r", "ray_g", "ray_b", "ray_length", "ray_confidence"}); }

  std::vector<Pass> hierarchy() const {
    std::vector<Pass> passes = {{.name = "nearness",
                                 .kernel = "ssr_nearness",
                                 .source = "ssr/hierarchy.cl",
                                 .reads = {"depth"},
                                 .writes = Bindings{nearness()} + list()}};
    if (c_.traversal) {
      passes.back().reads.push_back("back_depth");
      passes.back().writes = passes.back().writes + Bindings{farness(), plane_of_rays("others")};
    }
    for (int level = 1; level < levels(); ++level) {
      passes.push_back({.name = "level " + std::to_string(level),
                        .kernel = "ssr_level",
                        .source = "ssr/hierarchy.cl",
                        .writes = {nearness(), farness()},
                        .defines = {{"LEVEL", level}},
                        .scale = 1 << level});
    }
    return passes;
  }

  std::vector<Pass> until_met() const {
    std::vector<Pass> passes = hierarchy();
    passes.push_back(choose_rays());
    passes.push_back(march());
    return passes;
  }

  Pass choose_rays() const {
    return {.name = "rays",
            .kernel = "ssr_rays",
            .source = "ssr/rays.cl",
            .reads = reflector(),
            .writes = list() + rays() + met(),
            .can_skip = true};
  }

  Pass march() const {
    Pass pass{.name = "march",
              .kernel = "ssr_march",
              .source = "ssr/march.cl",
              .reads = Bindings{"depth", "normal"} + cells(has_both_depths()) + list() + directions(),
              .writes = {plane_of_rays("met")},
              .defines = {{"BOTH_DEPTHS", has_both_depths()}}};
    if (c_.traversal) {
      pass.reads.push_back("back_depth");
      pass.writes = pass.writes + of_rays({"left_at", "others"});
    }
    return pass;
  }

  /// In the other eye a ray ends where it passes behind a surface, so it does not use the farthest depth.
  Pass march_in_other() const {
    Bindings cells_of_other = cells(false);
    for (Binding& cell : cells_of_other) cell.from = From::other_view;
    return {.name = "march on",
            .kernel = "ssr_march",
            .source = "ssr/march.cl",
            .reads = Bindings{"depth", "normal"} + cells_of_other + Bindings{{"list", "ssr_others", c_.rays}} +
                     directions() + of_rays({"left_at"}) + of_other_eye({"normal"}) +
                     Bindings{from(From::other_view, "back_depth")},
            .writes = {{"met", "ssr_met_in_other", c_.rays}},
            .defines = {{"BOTH_DEPTHS", 0}, {"IN_OTHER", 1}}};
  }

  /// The environment is black by default, and then nothing is read for it.
  Bindings factors_on_environment() const {
    const bool is_black =
        p_.environment == 0 && p_.environment_r == 0 && p_.environment_g == 0 && p_.environment_b == 0;
    return is_black ? Bindings{} : Bindings{"specular_occlusion"};
  }

  /// Texels a side of the map that mirrors show: .8 degrees each.
  Pass with_map(Pass pass) const {
    return p_.environment == 0 ? pass : with_environment(std::move(pass), p_, EnvironmentLight::finest);
  }

  Pass see() const {
    Pass pass{.name = "see",
              .kernel = "ssr_see",
              .source = "ssr/shade.cl",
              .reads = image() + rays() + met(),
              .writes = Bindings{{"hit_length", "hit"}} + seen()};
    pass.may_read = factors_on_environment();
    if (c_.traversal) pass.reads.push_back(plane_of_rays("left_at"));
    if (c_.traversal || c_.fade) pass.reads = pass.reads + of_other_eye(image());
    return with_map(std::move(pass));
  }

  Pass resolve() const {
    Pass pass{.name = "resolve",
              .kernel = "ssr_resolve",
              .source = "ssr/resolve.cl",
              .reads = reflector() + rays() + seen(),
              .writes = {{"reflection", c_.accumulates ? "reflection_raw" : "reflection"}},
              .may_read = factors_on_environment(),
              .footprint = {.columns = 2, .rows = 2},
              .can_skip = true};
    if (c_.accumulates) pass.writes.push_back({"reach", "ssr_reach"});
    if (c_.reprojection)
      pass.reads = pass.reads + Bindings{"instance"} + of_other_eye(Bindings{"depth", "instance"} + rays() + seen());
    return with_map(std::move(pass));
  }

  Pass accumulate() const {
    return {.name = "accumulate",
            .kernel = "ssr_accumulate",
            .source = "ssr/accumulate.cl",
            .reads = reflector() + Bindings{"motion",
                                            {"reach", "ssr_reach"},
                                            {"now", "reflection_raw"},
                                            from(From::frame_before, "history"),
                                            from(From::frame_before, "history_depth"),
                                            from(From::frame_before, "history_frames")},
            .writes = {"reflection", "frames"},
            .footprint = {.columns = 2, .rows = 2},
            .can_skip = true};
  }

  std::vector<Pass> with_defines(std::vector<Pass> passes) const {
    const Defines defines = {{"LEVELS", levels()},
                             {"RAYS", c_.rays},
                             {"NEIGHBOURS", c_.neighbours},
                             {"JITTER", c_.jitter},
                             {"STEREO", std::is_same_v<Params, StereoSsrParams>},
                             {"MASK_ALONE", std::is_same_v<Params, ReflectionMaskParams>},
                             {"TEMPORAL", c_.accumulates},
                             {"TRAVERSAL", c_.traversal},
                             {"FADE", c_.fade},
                             {"REPROJECTION", c_.reprojection},
                             {"OTHER_NEIGHBOURS", c_.other_neighbours}};
    for (Pass& pass : passes) pass.defines.insert(pass.defines.end(), defines.begin(), defines.end());
    return passes;
  }

  const Params& p_;
  Choices c_;
};

std::vector<Pass> sssr_passes(const SssrParams& p) { return Passes(p).all(); }
std::vector<Pass> stereo_passes(const StereoSsrParams& p) { return Passes(p).all(); }
std::vector<Pass> temporal_passes(const TemporalSssrParams& p) { return Passes(p).all(); }
std::vector<Pass> mask_passes(const ReflectionMaskParams& p) { return Passes(p).mask(); }

template <typename Params>
std::string assumption(const ParameterValues& values, const View& view) {
  const Params p = values.as<Params>();
  if (p.environment != 0 && (p.environment_r > 0 || p.environment_g > 0 || p.environment_b > 0))
    return "environment: environment_r, _g and _b have no effect with a map; leave them out, or environment";
  return environment_assumption(p, view, "");
}

Technique plain() {
  Technique t;
  t.name = "sssr";
  t.summary = "reflections by rays through the depth, chosen by roughness and shared among neighbours";
  t.paper = "Stachowiak, Uludag 2015";
  t.reads = {"depth", "normal", "color", "roughness", "reflectance"};
  t.may_read = {"specular_occlusion"};
  t.writes = t.outputs = {"reflection", "hit"};
  t.default_for = {"reflection", "hit"};
  t.over_time = "temporal-sssr";
  t.parameters = SssrParams::table();
  t.presets = {{"low", {{"rays", "1"}, {"neighbours", "9"}}},
               {"medium", {{"rays", "1"}, {"neighbours", "21"}}},
               {"high", {{"rays", "2"}, {"neighbours", "21"}}},
               {"ultra", {{"rays", "4"}, {"neighbours", "25"}}}};
  t.passes = passes_of(sssr_passes);
  t.recommended = "surfaces reflect, and the frame has roughness and reflectance";
  t.assumes = assumption<SssrParams>;
  // No mask: rays are listed one by one, so a mask saves little where surfaces reflect at all.
  t.effect = {.name = "reflections",
              .changes = "reflection",
              .mask = "reflection-mask",
              .probe_resolution = 4,
              .most_share = 0.3,
              .somewhere = "a surface reflects something that the image shows",
              .nowhere = "no surface reflects anything that the image shows"};
  return t;
}

Technique for_two_eyes() {
  Technique t = plain();
  t.name = "stereo-ssr";
  t.summary = "reflections for two eyes: rays go on in the other's image, and both share them";
  t.paper = "Wu, Xu, Wang 2024";
  t.reads.insert(t.reads.end(), {"back_depth", "instance"});
  t.default_for.clear();
  t.over_time.clear();
  t.recommended.clear();
  t.views = 2;
  t.parameters = StereoSsrParams::table();
  // The same number of pixels in the other eye.
  for (Preset& preset : t.presets) {
    const auto own = preset.settings;
    for (const auto& [name, value] : own) {
      if (name == "neighbours") preset.settings.emplace_back("other_neighbours", value);
    }
  }
  t.passes = passes_of(stereo_passes);
  t.assumes = assumption<StereoSsrParams>;
  t.effect = {.name = "reflections alike in two views",
              .refines = "sssr",
              .mask = "stereo-visibility",
              .probe_resolution = 4,
              .least_share = 0.3,
              .somewhere = "each view's rays serve the other, since both see the same",
              .nowhere = "the two views have too little in common"};
  return t;
}

Technique over_frames() {
  Technique t = plain();
  t.name = "temporal-sssr";
  t.summary = "reflections of a sequence: each frame reuses those of the frame before on the same surfaces";
  t.paper = "Stachowiak, Uludag 2015; Yang, Liu, Salvi 2020";
  t.reads.insert(t.reads.end(), {"motion", "history", "history_depth", "history_frames"});
  t.outputs = {"reflection", "hit", "frames"};
  t.writes = {"reflection", "hit", "frames", "reflection_raw"};
  t.default_for.clear();
  t.over_time.clear();
  t.recommended.clear();
  t.parameters = TemporalSssrParams::table();
  t.passes = passes_of(temporal_passes);
  t.assumes = assumption<TemporalSssrParams>;
  t.effect = {};
  return t;
}

Technique where() {
  Technique t;
  t.name = "reflection-mask";
  t.summary = "where a surface reflects something that the image shows";
  t.paper = "after Stachowiak, Uludag 2015";
  t.reads = {"depth", "normal", "roughness", "reflectance"};
  t.writes = {"mask"};
  t.parameters = ReflectionMaskParams::table();
  t.passes = passes_of(mask_passes);
  return t;
}

}  // namespace

std::vector<Technique> ssr() { return {plain(), over_frames(), for_two_eyes(), where()}; }

}  // namespace gloam::techniques
