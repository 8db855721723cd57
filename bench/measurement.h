// What `gloam bench` measures: frames, the techniques on them, and what came of it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks.h"
#include "bench/growth.h"
#include "bench/ladder.h"
#include "bench/race.h"
#include "bench/subject.h"
#include "bench/variations.h"
#include "gloam/radius.h"

namespace gloam::bench {

/// For which rows it is measured where their error comes from: this takes longest.
enum class LadderFor { none, presets, all };

/// What is measured on every frame.
struct MeasureOptions {
  std::vector<const Technique*> techniques;
  std::vector<std::string> presets;  ///< these only; empty: all
  std::vector<std::string> variants;
  std::vector<Sweep> sweeps;
  /// Off: of techniques over all peeled layers, which take several times as long, one preset and no variants.
  bool layers_in_full = true;
  LadderFor ladder = LadderFor::presets;
  int rounds = 9;
  bool checks = true;                    ///< other resolutions, and on the first frame bare planes (checks.h)
  std::vector<const Technique*> growth;  ///< techniques whose growth is measured, on the first frame
  std::filesystem::path folder;          ///< where images/ goes; empty: no pictures
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

/// A frame that is measured on.
struct Subject {
  std::string name, scene_class;  ///< "own" for the user's frame
  Frame frame;
  std::string holds;  ///< "beauty.exr has only R, G, B"
  Radius radius;
  std::optional<Truth> given;      ///< --truth
  const Truth* truth = nullptr;    ///< that, or traced; null: none
  std::unique_ptr<Truths> truths;       ///< where the scene is at hand
  unsigned long long memory_bytes = 0;  ///< that measuring was planned to take; 0 where nobody planned
};

/// One row of the table.
struct Row : Racer {
  std::string scene;
  int width = 0, height = 0;
  Errors errors;
  Ladder ladder;
  std::string image;  ///< below the folder; empty: none
};

struct Skipped {
  std::string technique, preset, scene, why;  ///< no preset: all of them; no scene: on every one
};

struct SceneFacts {
  std::string name, scene_class;
  int width = 0, height = 0;
  Radius radius;
  double radius_pixels = 0;
  std::optional<double> truth_noise,
      truth_rays;           ///< RMS; per pixel, of a truth that was given as far as its header says
  std::string truth_image;  ///< below the folder; empty: none
  bool traced = false;      ///< the scene was at hand
  std::vector<std::string> made, reused;
};

struct GrowthFacts {
  std::string technique, scene;
  Growth growth;
};

/// What more samples would lead to, without a filter.
struct ConvergedFacts {
  const Technique* technique = nullptr;
  std::string scene;
  Errors errors;
};

struct Measurement {
  std::vector<std::unique_ptr<Row>> rows;
  std::vector<Skipped> skipped;
  std::vector<GrowthFacts> growth;
  std::vector<ConvergedFacts> converged;
  std::vector<ScaleFacts> scales;
  std::vector<PlaneFacts> planes;
  std::vector<SceneFacts> scenes;
  std::vector<std::string> notes;  ///< one sentence each
};

/// Presets of a technique that are asked for; "" where it has none, and all are.
std::vector<std::string> presets_of(const Technique& technique, const MeasureOptions& options);

/// Whether a technique is measured with one preset only.
bool in_short(const Technique& technique, const MeasureOptions& options);

/// Everything of one technique: its presets, and variants of one of them.
std::vector<Variation> variations_of(const Technique& technique, double radius, const MeasureOptions& options);

/// Measures everything on one frame; what is measured once, on the first. What a frame or a device does not allow is skipped, and said.
void measure(Subject& subject, const MeasureOptions& options, bool is_first, Device& device, Measurement& result);

}  // namespace gloam::bench
