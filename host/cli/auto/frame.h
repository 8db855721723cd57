// The steps of gloam auto on one frame, alone or in a shot.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "auto/automatic.h"
#include "auto/budget.h"
#include "cli/flags/options.h"
#include "cli/flags/radius.h"
#include "frame/unfit.h"
#include "gloam/composition.h"

namespace gloam::cli {

/// An effect from its probe to its planes.
struct Outcome {
  Decision decision;
  std::vector<std::string> outputs;
  std::optional<Plan> plan;  ///< the plan that was run, or would have been
  bool is_masked = false;
  double ms = 0;  ///< on the device, classification and mask included
  /// Without classification; NaN: not measured.
  double ms_masked = std::numeric_limits<double>::quiet_NaN(), ms_everywhere = std::numeric_limits<double>::quiet_NaN();
  /// RMS of the picture's colour; NaN: not known. `change`: by the effect. `lost`: expected error by what was chosen for it.
  double change = std::numeric_limits<double>::quiet_NaN(), lost = std::numeric_limits<double>::quiet_NaN();
  std::string setting;       ///< "medium, half", where a budget chose
  bool is_left_out = false;  ///< wanted, but the budget does without
  /// For each pixel of the glance, by view, how far the effect changes the picture (`Glance::change_by`); empty: not known.
  std::map<std::string, Plane> changes;
  /// Whether it is computed.
  bool runs() const { return decision.effect.is_wanted && !is_left_out; }
};

/// An effect whose planes the frame has, and its request.
struct Candidate {
  const Technique* technique;
  PlanRequest asked;
};

struct Candidates {
  std::vector<Candidate> possible;
  std::vector<Outcome> impossible;  ///< effects that cannot be computed, with the reason
};

/// A frame that is open, with the effects that it may call for.
struct AutoFrame {
  FrameFiles files;
  Candidates candidates;
  std::vector<std::string> planes;       ///< to decode
  std::vector<std::vector<Plan>> plans;  ///< that may run, by effect
  std::vector<Unfit> unfit;              ///< planes of the files that nothing is computed from
};

/// What is to be made of a frame beside its effects.
struct AutoPurpose {
  bool explains = false;          ///< --explain: colour is decoded for a picture
  bool looks_at_picture = false;  ///< --composite, --budget, --error: what effects change in the picture matters
  ComposeOptions composing;
};

/// `unfit`: planes that no effect is computed from: what needs one is not possible, and for others a plane is made in its place. Throws an
/// error with all reasons if no effect is possible, and for a setting that no effect has.
AutoFrame planned_auto(FrameFiles files, const PlanRequest& asked, const AutoPurpose& purpose,
                       const std::vector<Unfit>& unfit = {});

/// Throws Error for files without depth, if effects are to be written: what holds all light already has none to add.
void check_has_depth(const AutoFrame& planned, const std::string& out);

/// Decodes the planes, and plans again without those that turned out to be unfit, which are left out of the frame (but for colour,
/// which pictures show).
Frame read_and_judge(AutoFrame& planned, const PlanRequest& asked, const AutoPurpose& purpose);

/// Whether the frame is of a light-field display.
bool is_of_display(const FrameFiles& files);

/// Moves all planes, view by view.
void take_planes(Frame& from, Frame& to);

/// All effects take this radius where none is asked for.
void set_radius(AutoFrame& planned, std::optional<double> radius);

/// Memory, bytes: at most, and what is left of it for the results once computing has ended.
unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory);
unsigned long long bytes_of_results(const AutoFrame& planned);

/// What was decided on the first frame of a shot, for all its frames.
struct FixedEffect {
  bool runs = false;
  PlanRequest request;
  std::string why, setting;
};
/// By the effect's technique.
using FixedEffects = std::map<std::string, FixedEffect>;

struct AutoSettings {
  MaskUse mask = MaskUse::measured;
  bool measures = false;  ///< --measure
  AutoPurpose purpose;
  RadiusSource radius_from = RadiusSource::frame;
  BudgetGoal goal;  ///< empty: effects are computed at the preset and the resolution asked for
  /// If set, nothing is weighed on the frame: effects that are not among these are decided by their masks alone.
  std::optional<FixedEffects> fixed = {};
  std::function<void(int done, int of)> measuring = {};  ///< progress of the table of speeds, made once on a device
};

/// What gloam auto makes of a frame.
struct AutoResult {
  Frame frame;  ///< with planes of every effect, without depth
  std::vector<Outcome> outcomes;
  std::optional<Radius> used_radius;
  std::optional<RadiusReport> radius;
  std::optional<Spent> spent;  ///< of a budget
  double glance_ms = 0;        ///< device time of looking at the picture
};

/// Whether what effects change in the picture decides about any of them.
bool looks_at_changes(const Candidates& candidates);

/// What other frames of a shot take over from the first: all effects if a budget was spent, else those that were too faint, so that no
/// effect comes and goes by what it changes.
FixedEffects fixed_by(const AutoResult& first);

/// Decides and computes. `frame`: as decoded, with its radius set. Takes the effects that cannot be computed from `planned`.
AutoResult compute_effects(AutoFrame& planned, const AutoSettings& settings, const Frame& frame, Device& device,
                           const RunOptions& options);

}  // namespace gloam::cli
