// Results of any technique of the registry on any frame, and their comparison.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::stress {

Settings operator+(Settings a, const Settings& b);
/// "directions = 4, jitter = off"; "defaults" if there are none.
std::string text_of(const Settings& settings);
/// A value as text that a parameter reads back to the same bits.
std::string exact(double value);

/// 1 and the device's own lane width, each once.
std::vector<int> usual_lanes(const Device& device);
/// Fast mathematics with the most of these lanes, and precise with one.
std::vector<RunOptions> two_ways(const Device& device);

/// The plan for all outputs of a technique, from the planes of the frame. Planes that no technique makes are invented (frames.h)
/// and added to the frame, and a second view if the technique needs two.
Plan plan_for(const Technique& technique, Frame& frame, const Settings& settings = {});
/// The same for a request; its first output is a technique.
Plan plan_for(const PlanRequest& request, Frame& frame);

/// Plans and runs; returns the outputs.
Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 Device& device);

/// A setting for every parameter in scene units of the planned techniques: `value` of its default.
Settings set_lengths(const Technique& technique, Frame& frame, const std::function<double(double)>& value);

/// The technique's cheapest preset, for properties that hold for any number of samples: loops over samples are unrolled, and
/// compile time grows with them. Empty if there are no presets.
Settings few_samples(const Technique& technique);

/// The defaults, and every other value of each choice and switch, one at a time, with few samples, but for those that planning refuses.
std::vector<Settings> variants(const Technique& technique, Frame& frame);

/// Computed planes whose values lie in 0..1: AO, cones, masks.
std::vector<std::string> unit_interval_outputs(const Plan& plan);

/// Whether all pixels of all planes of two frames of the same size have the same bits; padding does not count.
bool same_bits(const Frame& a, const Frame& b);

/// A pixel of a plane, and its value.
struct Place {
  std::string view, plane;  ///< no plane: no pixel is meant
  int x = 0, y = 0;
  std::string holds;  ///< "0.5 against 0.25"
};

/// Largest and mean absolute difference over all pixels and components, and the position of the largest. Equal infinities differ
/// by 0; a value that is finite in only one of the two differs by infinity.
struct Difference {
  double max = 0, mean = 0;
  Place place = {};
};
Difference difference(const Plane& a, const Plane& b);
Difference difference(const Frame& a, const Frame& b);

/// Share of the values of all planes that differ by more than a limit.
double share_over(const Frame& a, const Frame& b, double limit);

/// The first value that the kind of its plane does not allow: not finite, outside 0..1, a vector neither zero nor unit, a depth
/// that is not positive. No plane if there is none.
Place first_violation(const Frame& frame);
/// The same as text, "ao = nan at (3, 4)"; empty if there is none.
std::string violation(const Frame& frame);

/// Largest distance of planes of 0..1 from their value where nothing is near (1 for AO).
Difference distance_from_open(const Plan& plan, const Frame& outputs);

}  // namespace gloam::stress
