// The technique `evidence` against ray-traced truth, beside the techniques with one thickness for all occluders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "evidence/coefficients.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "support/estimate.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

/// What a built-in scene's own camera shows.
Frame seen_in(const gloam::Scene& scene) {
  constexpr int width = 480, height = 270;
  CaptureOptions options{.width = width, .height = height, .planes = {"depth", "normal"}};
  options.views = {{"", camera_for(scene.cameras.front(), width, height), {}}};
  return capture(Tracer(scene), options).frame;
}

/// Of filtered AO on surfaces.
double rmse_of(const std::string& technique, const std::string& preset, const Frame& frame, const Frame& truth,
               double radius) {
  const PlanRequest request{.outputs = {technique}, .preset = preset, .radius = radius};
  const Frame out = run(make_plan(request, {"depth", "normal"}, "the frame"), frame, device(), {}).frame;
  double sum = 0;
  long long count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (!std::isfinite(value_at(frame, "depth", x, y))) continue;
      sum += std::pow(value_at(out, "ao", x, y) - value_at(truth, "ao", x, y), 2);
      ++count;
    }
  }
  return std::sqrt(sum / double(count));
}

TEST(Evidence, IsNearerToTheTruthThanOneThickness) {
  for (const char* name : {"courtyard", "lounge", "statue"}) {
    const gloam::Scene scene = load_scene(name, {});
    const Frame frame = seen_in(scene);
    const Frame truth = ao_reference(Tracer(scene), frame, {.radius = scene.ao_radius, .samples = 64}).frame;
    for (const char* preset : {"low", "medium", "high", "ultra"}) {
      const double gtao = rmse_of("gtao", preset, frame, truth, scene.ao_radius),
                   bitmask = rmse_of("bitmask", preset, frame, truth, scene.ao_radius),
                   evidence = rmse_of("evidence", preset, frame, truth, scene.ao_radius);
      std::printf("%s, %s: gtao %.4f, bitmask %.4f, evidence %.4f\n", name, preset, gtao, bitmask, evidence);
      EXPECT_LT(evidence, std::min(gtao, bitmask)) << name << ", " << preset;
    }
  }
}

using SlicesAndSteps = std::pair<std::string, std::string>;

/// What the coefficients were fitted with that the technique takes for these settings.
SlicesAndSteps fitted_with(const Settings& settings) {
#define DIRECTIONS_AND_STEPS(directions, steps, ...) {#directions, #steps},
  const std::vector<SlicesAndSteps> rows = {EVIDENCE_COEFFICIENTS(DIRECTIONS_AND_STEPS)};
  const Technique& technique = find_technique("evidence");
  ParameterValues values(technique.parameters);
  for (const auto& [name, value] : settings) values.set(name, value, technique.name);
  const std::vector<Pass> passes = technique.passes(values);
  for (const auto& [name, value] : passes.front().defines) {
    if (name == "COEFFICIENTS") return rows.at(size_t(value));
  }
  throw std::out_of_range("no COEFFICIENTS");
}

/// Coefficients of one number of steps do not suit another.
TEST(Evidence, EachPresetHasItsOwnCoefficients) {
  const Technique& technique = find_technique("evidence");
  for (const Preset& preset : technique.presets) {
    const std::map<std::string, std::string> values(preset.settings.begin(), preset.settings.end());
    EXPECT_EQ(fitted_with(preset.settings), SlicesAndSteps(values.at("directions"), values.at("steps"))) << preset.name;
  }
  EXPECT_EQ(fitted_with(technique.converged), SlicesAndSteps("4", "18"));
}

}  // namespace
}  // namespace gloam::test
