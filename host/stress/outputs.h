// What any technique of the registry makes of any frame, and comparing what comes out.
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
/// "directions = 4, jitter = off"; "defaults" where there are none.
std::string text_of(const Settings& settings);
/// A value as text that a parameter reads back to the same bits.
std::string exact(double value);

/// 1 and the device's own width, each once.
std::vector<int> usual_lanes(const Device& device);

/// The plan for everything that a technique puts out, from the planes of the frame. Planes that nothing makes are
/// invented (frames.h) and added to the frame, and a second view where the technique needs two.
Plan plan_for(const Technique& technique, Frame& frame, const Settings& settings = {});

/// Plan and run; the planes asked for.
Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 Device& device);

/// A setting for every parameter of the planned techniques whose unit is scene units: as `value` says of its default.
Settings set_lengths(const Technique& technique, Frame& frame, const std::function<double(double)>& value);

/// The technique's cheapest preset, for properties that hold for any number of samples: loops over samples are unrolled, and the
/// compiler's time grows with them. Empty where there are no presets.
Settings few_samples(const Technique& technique);

/// The defaults, and each other value of each choice and switch by itself, with few samples.
std::vector<Settings> variants(const Technique& technique, Frame& frame);

/// Planes whose values lie in 0..1 and that are computed: AO, cones, masks.
std::vector<std::string> unit_interval_outputs(const Plan& plan);

/// Whether all pixels of all planes of both (of the same size) have the same bits; padding does not count.
bool same_bits(const Frame& a, const Frame& b);

/// A pixel of a plane, and what it holds.
struct Place {
  std::string view, plane;  ///< no plane: nothing is wrong anywhere
  int x = 0, y = 0;
  std::string holds;  ///< "0.5 against 0.25"
};

/// Largest and mean absolute difference over all pixels and components, and where the largest is; equal infinities differ by 0.
/// A value that only one of both has as a finite number differs by infinity.
struct Difference {
  double max = 0, mean = 0;
  Place place = {};
};
Difference difference(const Plane& a, const Plane& b);
Difference difference(const Frame& a, const Frame& b);

/// Share of the values of all planes that differ by more than a limit.
double share_over(const Frame& a, const Frame& b, double limit);

/// The first value that the kind of its plane does not allow: not finite, outside 0..1, a vector neither zero nor unit, a
/// depth that is not positive. No plane where there is none.
Place first_violation(const Frame& frame);
/// The same as text, "ao = nan at (3, 4)"; empty where there is none.
std::string violation(const Frame& frame);

/// Largest distance of the planes that lie in 0..1 from what they hold where nothing is near (1 for AO).
Difference distance_from_open(const Plan& plan, const Frame& outputs);

}  // namespace gloam::stress
