// Running any technique of the registry on any frame, and comparing what comes out.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam::test {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// The device whose name holds `text` (empty: the one gloam picks), opened once per program. The second OpenCL on CPUs,
/// Rusticl on llvmpipe, is switched on before the first is opened, unless GLOAM_ONE_OPENCL is set in the environment.
Device& device(const std::string& text = "");
/// Whether there is such a device.
bool has_device(const std::string& text);
/// 1 and the device's own width, each once.
std::vector<int> usual_lanes(Device& device);

/// The plan for everything that a technique puts out, from the planes of the frame. Planes that nothing makes are
/// invented (frames.h) and added to the frame.
Plan plan_for(const Technique& technique, Frame& frame, const Settings& settings = {});

/// Plan and run; the planes asked for.
Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 const std::string& device_name = "");

/// A setting for every parameter of the planned techniques whose unit is scene units: as `value` says of its default.
Settings set_lengths(const Technique& technique, Frame& frame, const std::function<double(double)>& value);

/// The technique's cheapest preset, for tests that hold for any number of samples: loops over samples are unrolled, and the
/// compiler's time grows with them. Empty where there are no presets.
Settings few_samples(const Technique& technique);

/// Planes whose values lie in 0..1 and that are computed: AO, cones, masks.
std::vector<std::string> unit_interval_outputs(const Plan& plan);

/// Whether all pixels of all planes of both (of the same size) have the same bits; padding does not count.
bool same_bits(const Frame& a, const Frame& b);
/// Largest and mean absolute difference over all pixels and components; equal infinities differ by 0. A value that only
/// one of both has as a finite number differs by infinity.
struct Difference {
  double max = 0, mean = 0;
};
Difference difference(const Plane& a, const Plane& b);
Difference difference(const Frame& a, const Frame& b);

/// Empty, or what is wrong with the first value that the kind of its plane does not allow: not finite, outside 0..1, a
/// vector neither zero nor unit, a depth that is not positive.
std::string violation(const Frame& frame);

/// Name for a test: letters, digits and underscores, "hbao_plus".
std::string identifier(const std::string& name);

/// The text of a kernel file.
std::string kernel_text(const Technique& technique);

}  // namespace gloam::test
