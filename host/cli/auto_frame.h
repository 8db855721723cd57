// The steps of gloam auto on one frame, alone or in a shot.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/radius.h"
#include "plan/automatic.h"

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
};

/// Throws an error with all reasons if no effect is possible, and for a setting that no effect has. `explains`: colour is decoded
/// for a picture.
AutoFrame planned_auto(FrameFiles files, const PlanRequest& asked, bool explains);

/// All effects take this radius where none is asked for.
void set_radius(AutoFrame& planned, std::optional<double> radius);

/// Memory, bytes: at most, and what is left of it for the results once computing has ended.
unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory);
unsigned long long bytes_of_results(const AutoFrame& planned);

struct AutoSettings {
  MaskUse mask = MaskUse::measured;
  bool measures = false, explains = false;  ///< --measure, --explain
  RadiusSource radius_from = RadiusSource::frame;
};

/// What gloam auto makes of a frame.
struct AutoResult {
  Frame frame;  ///< with planes of every effect, without depth
  std::vector<Outcome> outcomes;
  std::optional<Radius> used_radius;
  std::optional<RadiusReport> radius;
};

/// Decides and computes. `frame`: as decoded, with its radius set. Takes the effects that cannot be computed from `planned`.
AutoResult compute_effects(AutoFrame& planned, const AutoSettings& settings, const Frame& frame, Device& device,
                           const RunOptions& options);

}  // namespace gloam::cli
