// Measurements of `gloam bench`: frames, techniques on them, and results.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/radius.h"
#include "measure/checks.h"
#include "measure/growth.h"
#include "measure/ladder.h"
#include "measure/race.h"
#include "measure/schedule.h"
#include "measure/similarity.h"
#include "measure/subject.h"
#include "measure/variations.h"
#include "measure/wanted_rows.h"

namespace gloam::bench {

using report::LeftOut;
using report::Skipped;

/// The rows whose error is split into steps (the ladder), which takes longest.
enum class LadderFor { none, presets, all };

/// Options for the measurements on every frame.
struct MeasureOptions {
  std::vector<const Technique*> techniques;
  std::vector<std::string> presets;  ///< only these; empty: all
  std::vector<std::string> variants;
  std::vector<Sweep> sweeps;
  std::vector<WantedRow> rows;  ///< these only, in place of presets, variants and sweeps; empty: as those say
  /// Off: techniques over all peeled layers, which take several times as long, get one preset and no variants.
  bool layers_in_full = true;
  LadderFor ladder = LadderFor::presets;
  int rounds = 9;             ///< without a time limit, and with `fixed_rounds`
  TimeLimit limit;            ///< of all subjects together; none: everything is measured
  bool fixed_rounds = false;  ///< within a limit: `rounds`, rather than until the interval of each ratio is narrow
  bool checks = true;         ///< other resolutions, and bare planes on the first frame (checks.h)
  std::vector<const Technique*> growth;  ///< techniques whose growth is measured on the first frame
  std::filesystem::path folder;          ///< folder of images/; empty: no pictures
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

/// A frame to measure on.
struct Subject {
  std::string name, scene_class;  ///< "own" for the user's frame
  std::string effect = "ao";      ///< the plane that is measured (effects.h)
  Frame frame;
  std::string holds;  ///< "beauty.exr has only R, G, B"
  Radius radius;
  std::optional<Truth> given;           ///< --truth
  const Truth* truth = nullptr;         ///< the given or the traced one; null: none
  std::unique_ptr<Truths> truths;       ///< null without a scene
  unsigned long long memory_bytes = 0;  ///< memory that the measurement was planned for; 0: not planned
};

/// One row of the table.
struct Row : Racer {
  std::string scene, effect;
  int width = 0, height = 0;
  Errors errors;
  Similarity similarity;
  std::optional<double> inconsistency;  ///< of the two views of a frame (similarity.h)
  Ladder ladder;
  std::string image;  ///< below the folder; empty: none
};

struct Measurement {
  std::vector<std::unique_ptr<Row>> rows;
  std::vector<Skipped> skipped;
  std::vector<Growth> growth;
  std::vector<report::Converged> converged;
  std::vector<ScaleChange> scales;
  std::vector<PlaneReading> planes;
  std::vector<report::Scene> scenes;
  std::vector<std::string> notes;  ///< one sentence each
  std::vector<LeftOut> left_out;
};

/// The presets of a technique, or of its source (effects.h), that were asked for; "" if it has none and all were asked for.
std::vector<std::string> presets_of(const Technique& technique, const MeasureOptions& options);

/// Whether a technique is measured with one preset only.
bool in_short(const Technique& technique, const MeasureOptions& options);

/// All variations of one technique: its presets, and variants of one of them.
std::vector<Variation> variations_of(const Technique& technique, double radius, const MeasureOptions& options);

/// The same options for the techniques of one effect. Other resolutions and bare planes are checked for ambient occlusion alone.
MeasureOptions for_effect(const MeasureOptions& options, const std::string& plane);

/// Measures one effect on one frame, all of whose techniques make it; with `is_first`, also everything that is measured only once. What the frame or the device does not
/// allow is skipped and listed.
void measure(Subject& subject, const MeasureOptions& options, bool is_first, Device& device, Measurement& result);

}  // namespace gloam::bench
