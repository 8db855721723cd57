// Effects that the frames of a shot call for.
#pragma once

#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sequence/auto_files.h"
#include "shot/shot_run.h"
#include "shot/whole_picture.h"

namespace gloam {

/// What all frames have in common.
struct AutoShotSettings {
  PlanRequest asked;
  AutoSettings computing;
  std::optional<double> radius;  ///< made from the first frame, for those effects that none is asked for
  RunOptions options;
  WriteOptions writing;
  std::optional<FramePattern> output;         ///< none: a composite alone
  std::optional<LightChoice> composite = {};  ///< none: no composite
  std::optional<FramePattern> composite_output = {};
  bool keeps_depth = false;
  std::vector<Unfit> unfit;  ///< of the first frame, left out of all: nothing comes and goes by a share of pixels
  int decider = 0;           ///< number of that frame
  std::string contents;      ///< as FrameStep::settings_of
};

/// Most that `gloam auto` takes on a frame with the planes read, bytes.
unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory);
/// Most that a frame takes beside what computing takes, bytes.
unsigned long long bytes_in_flight(const AutoFrame& planned, const std::optional<CompositeSource>& source);

/// In which frames which effects were wanted.
class EffectTally {
 public:
  void add(int frame, const std::vector<Outcome>& outcomes);
  /// "ambient occlusion: wanted in 3 of 5 frames: gtao in 1-3; not wanted in 4-5, and written as if computed there"
  std::vector<std::string> in_words() const;

 private:
  /// By what was done there: a technique's name; "" where it was not wanted.
  using FramesByTechnique = std::map<std::string, std::vector<int>>;
  std::map<std::string, FramesByTechnique> effects_;  ///< by their names
  std::map<std::string, size_t> frames_;
};

/// The effects that each frame of a shot calls for.
class AutoStep : public FrameStep {
 public:
  /// All that is given has to live as long as the step.
  AutoStep(const SequenceFiles& files, const AutoShotSettings& settings, Device& device, ShotEvents& events)
      : files_(files),
        settings_(settings),
        events_(events),
        decided_{{std::numeric_limits<int>::min(), {settings.computing, settings.contents}}},
        device_(device),
        notes_(files, events) {}

  /// Decides on the first frame what all frames take over, up to a cut, after which the next frame decides: nothing comes and goes by what it
  /// changes, and a budget is spent once. What was decided tells results by other decisions apart.
  void decide_on(AutoFrame& first);

  std::vector<ShotOutput> outputs() const override;
  std::string settings_of(const SequenceFrame& frame, const FrameFiles& /*files*/) override {
    return decided_for(frame.number).contents;
  }
  std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) override;

  const EffectTally& tally() const { return tally_; }

 private:
  class Work;

  /// What holds from a frame on.
  struct Decided {
    AutoSettings computing;
    std::string contents;
  };
  const Decided& decided_for(int frame) const { return std::prev(decided_.upper_bound(frame))->second; }
  /// `what`: the frames that it holds for, in words.
  Decided decided_on(AutoFrame& frame, const std::string& what);
  AutoFrame planned(FrameFiles files) const;

  /// What a frame shows to be unfit is used all the same if it was sound in the first.
  void add_notes(const FrameTurn& turn, std::vector<std::string> notes);

  const SequenceFiles& files_;
  const AutoShotSettings& settings_;
  ShotEvents& events_;
  std::map<int, Decided> decided_;  ///< by the first frame; never empty
  Device& device_;
  ShotNotes notes_;
  EffectTally tally_;
  bool is_composition_told_ = false;
};

}  // namespace gloam
