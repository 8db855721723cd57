// gloam bench --sequence SHOT
#pragma once

#include <string>
#include <vector>

#include "cli/bench/subjects.h"
#include "cli/flags/options.h"
#include "measure/sequence.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

struct SequenceBenchFlags {
  std::string sequence;             ///< "gallery:walk", "walk", or a pattern
  std::vector<std::string> truths;  ///< patterns
  std::string folder;
  FrameChoice choice;
  FrameFlags frame_flags;
  std::string reading;  ///< the first flag given that says how frames are read; empty if there is none
  bool has_size = false, names_techniques = false;
};

/// Throws UsageError for a shot that is not there (with the nearest name), for what is no pattern, and for flags that do not go
/// with the shot.
void check(const SequenceBenchFlags& flags);

/// Measures settings on the frames, writes bench.json to the folder, and prints a table. `scene`: how frames and truths of built-in
/// shots are made. `skipped`: techniques left out so far.
void bench_sequence(const SequenceBenchFlags& flags, const bench::MeasureOptions& options,
                    const bench::SceneOptions& scene, const std::vector<bench::Skipped>& skipped, Device& device,
                    const JsonFlag& json);

/// What settings give on frames.
struct MeasuredShot {
  bench::MeasuredSequence sequence;
  bench::SequenceMeasurement measured;
};

/// Measures settings on frames that are files. `outputs`: files that the command writes. `options` and `making`: as of `bench_sequence`.
/// Throws Error if nothing could be measured.
MeasuredShot measure_own_shot(const SequenceBenchFlags& flags, bench::MeasureOptions options,
                              bench::SceneOptions making, const std::vector<bench::Skipped>& skipped, Device& device,
                              const std::vector<NamedPath>& outputs);

}  // namespace gloam::cli
