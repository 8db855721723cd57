// What gloam bench measures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/bench/subjects.h"
#include "cli/flags/options.h"
#include "measure/measurement.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

/// What fails where a result is worse than its baseline.
enum class Regression { time, error, both };

/// The flags as given.
struct BenchCommand : DeviceFlags {
  std::vector<std::string> truths;
  VariantFlags variant;
  std::string paper, folder, effects, techniques, scenes, presets, frame, sequence, variants, set, items;
  std::vector<std::string> sweeps;
  std::optional<Size> size;
  std::optional<int> rays;
  std::optional<double> radius;
  int rounds = 9;
  double time = 60;  ///< seconds
  bool all = false;  ///< no limit
  std::string rows, baseline, google_benchmark;
  Regression regression = Regression::both;
  int processes = 0;  ///< 0: one, or as many as the earlier result has
  bench::LadderFor ladder = bench::LadderFor::presets;
  bool no_growth = false, no_checks = false, no_images = false, print = false;
  int chunks = 0;                     ///< 0: not divided
  std::vector<std::string> repeated;  ///< words for a chunk
  FrameChoice choice;
  FrameFlags frame_flags;
  JsonFlag json;
  const CLI::App* app = nullptr;
};

/// The request, checked.
struct BenchOptions : bench::MeasureOptions {
  std::vector<std::string> effects;  ///< planes that are measured
  std::vector<const SceneRecipe*> scenes;
  bench::SceneOptions scene;
};

/// Those measured without --scenes.
extern const std::vector<std::string> default_scenes;

/// Checks the request. Techniques that it leaves out are added to what `result` skipped. Throws UsageError.
BenchOptions options_of(const BenchCommand& flags, const DeviceInfo& device, bench::Measurement& result);

}  // namespace gloam::cli
