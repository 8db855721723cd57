// gloam auto as a library call: which effects a frame calls for, where, and how well within a time or an error; and their planes.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/composition.h"
#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/goal.h"
#include "gloam/plan.h"
#include "gloam/radius.h"
#include "gloam/run.h"
#include "gloam/unfit.h"

namespace gloam {

/// The choice for one effect, or for a technique that refines one.
struct EffectChoice {
  const Technique* technique = nullptr;
  bool is_wanted = false;
  bool is_too_faint = false;          ///< the mask wants it, but it hardly changes the picture
  bool is_everywhere = false;         ///< wanted on so much of the image that no mask is made
  std::string why;                    ///< in words, with the share
  double share = 0;                   ///< share of the probed tiles, over all views
  double classify_ms = 0;             ///< time of probing, on the device
  std::string cells;                  ///< the plane of `seen`; empty if nothing was probed
  std::shared_ptr<const Frame> seen;  ///< one pixel per tile of each view: above 0 where the effect is called for
};

/// The decision for an effect.
struct Decision {
  EffectChoice effect;
  std::vector<EffectChoice> refinements;  ///< at most one is wanted; it replaces the effect's technique
  PlanRequest request;                    ///< for the pixels that call for the effect
  PlanRequest everywhere;                 ///< for all pixels, without probing
};

/// Whether an effect is computed through its mask, if the decision has one, or everywhere: as stated, or whichever is faster.
enum class MaskUse { measured, always, never };

/// RMS error of the picture, as a look expects it of what is computed.
struct ExpectedError {
  double error = 0;
  double uncertainty = 0;     ///< standard deviation of the error
  double of_color_alone = 0;  ///< of the picture without any effect
};

struct Spent {
  double glance_ms = 0;  ///< of looking: probes for masks, and the glance
  /// The goal was not met: no choice is expected to reach the error, or nothing fits the time that the glance leaves.
  bool is_missed = false;
  double cheapest_ms = 0;  ///< of the fastest option of any effect, the glance included
  std::string cheapest;    ///< the effect and the option
  std::string why;         ///< why these options were chosen, in a sentence
};

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
  /// For each pixel of the glance, by view, how far the effect changes the picture (`Glance::changes_by`); empty: not known.
  std::map<std::string, Plane> changes;
  /// By view, the part of the picture that the effect changes most; empty: not known.
  std::map<std::string, PicturePart> parts;
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

/// What a frame is before its planes are decoded.
struct FrameFacts {
  std::string name;                 ///< of its file, for messages
  std::vector<std::string> planes;  ///< of every view
  std::string holds;                ///< the planes in words (`make_plan`)
  int width = 0, height = 0;        ///< pixels
  size_t views = 0;
  bool is_of_display = false;  ///< a light-field display
};
/// Of a frame in memory. `name`: in messages.
FrameFacts facts_of(const Frame& frame, const std::string& name = "the frame");

/// A frame with the effects that it may call for.
struct AutoPlan {
  FrameFacts facts;
  Candidates candidates;
  std::vector<std::string> planes;       ///< to decode
  std::vector<std::vector<Plan>> plans;  ///< that may run, by effect
  std::vector<Unfit> unfit;              ///< planes of the frame that nothing is computed from
  bool explains = false;                 ///< as `AutoPurpose` has it
};

/// What is to be made of a frame beside its effects.
struct AutoPurpose {
  bool explains = false;          ///< colour is decoded for a picture of what is called for where
  bool looks_at_picture = false;  ///< a composite or a goal: what effects change in the picture matters
  ComposeOptions composing;
};

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
  bool measures = false;  ///< everything is also computed everywhere, and timed
  AutoPurpose purpose = {};
  RadiusSource radius_from = RadiusSource::frame;
  /// Device time, that of looking included, or an expected RMS error of the picture; none: effects are computed at the preset and the
  /// resolution asked for.
  Goal goal = {};
  /// If set, nothing is weighed on the frame: effects that are not among these are decided by their masks alone.
  std::optional<FixedEffects> fixed = {};
  std::function<void(int done, int of)> measuring = {};  ///< progress of the table of speeds, made once on a device
  /// What is chosen is for frames that are not looked at: the time of looking does not count, and nothing is taken from the look.
  bool for_other_frames = false;
};

/// What gloam auto makes of a frame.
struct AutoResult {
  Frame frame;  ///< with planes of every effect, without depth
  std::vector<Outcome> outcomes;
  std::optional<Radius> used_radius;      ///< none: no effect that can be computed has one
  std::optional<double> radius_cap;       ///< share of the image's width (`cap_of`)
  std::optional<Spent> spent;             ///< of a budget
  std::optional<ExpectedError> expected;  ///< where the frame was looked at for a budget or an explanation
  std::optional<Frame> picture;           ///< of all that is computed, for an explanation
  double picture_rms = 0;                 ///< over surfaces, as the look saw it with all effects; 0: not known
  double glance_ms = 0;                   ///< device time of looking at the picture
  std::vector<std::string> notes;         ///< what does not suit the frame, and what was assumed: a sentence each
};

// --- In one call.

/// Decides which effects a frame calls for, and computes those. `frame`: normalised (`frame_from`, or read by gloam/exr.h), with all its
/// planes. `asked`: preset, resolution, settings and extras for all effects; its `outputs` stay empty. Without a radius in it, one is made
/// from the frame. `settings`: `purpose.looks_at_picture` is set for a goal, and `radius_from` is not read. Device time is in milliseconds,
/// errors are RMS of the picture's colour. Throws Error and UsageError as `plan_auto`, `check_goal` and `run` do.
AutoResult compute_auto(const Frame& frame, const PlanRequest& asked, AutoSettings settings, Device& device,
                        const RunOptions& options = {});

// --- In steps, for frames in files and shots.

/// `unfit`: planes that no effect is computed from: what needs one is not possible, and for others a plane is made in its place. Throws an
/// error with all reasons if no effect is possible, and for a setting that no effect has.
AutoPlan plan_auto(FrameFacts facts, const PlanRequest& asked, const AutoPurpose& purpose,
                   const std::vector<Unfit>& unfit = {});

/// Plans again without the planes that turned out to be unfit (`Frame::assumed`).
void judge(AutoPlan& planned, const std::vector<std::string>& assumed, const PlanRequest& asked,
           const AutoPurpose& purpose);

/// Throws UsageError or Error for a frame that effects cannot be weighed on. No goal: does nothing.
void check_goal(const Goal& goal, const AutoPlan& planned);

/// All effects take this radius where none is asked for.
void set_radius(AutoPlan& planned, std::optional<double> radius);

/// Memory beside the frame, bytes: at most, and what is left of it for the results once computing has ended.
unsigned long long bytes_beside_frame(const AutoPlan& planned, bool shares_memory);
unsigned long long bytes_of_results(const AutoPlan& planned);

/// Whether what effects change in the picture decides about any of them.
bool looks_at_changes(const Candidates& candidates);

/// What other frames of a shot take over from the first: all effects if a budget was spent, else those that were too faint, so that no
/// effect comes and goes by what it changes.
FixedEffects fixed_by(const AutoResult& first);

/// Decides and computes. `frame`: as decoded, with its radius set. Takes the effects that cannot be computed from `planned`.
AutoResult compute_effects(AutoPlan& planned, const AutoSettings& settings, const Frame& frame, Device& device,
                           const RunOptions& options);

// --- In words.

/// One line where a goal was missed, or is best met by the colour alone; empty otherwise.
std::string note_on_goal(const AutoResult& result, const Goal& goal);

/// JSON as `gloam auto --json` writes it: "effects", "classify_ms", "glance_ms", "total_ms", "device"; with a goal also "chosen",
/// "budget_ms" or "error_goal", "expected_error", "expected_error_uncertainty", "expected_error_of_color", "goal_met" and "why".
std::string json_of(const AutoResult& result, const Goal& goal, const DeviceInfo& device);

}  // namespace gloam
