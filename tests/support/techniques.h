// Running any technique of the registry on the devices that tests use.
#pragma once

#include <string>
#include <vector>

#include "support/stress.h"

namespace gloam::test {

/// The device whose name holds `text` (empty: gloam's own choice), opened once per program. Rusticl on llvmpipe, the second
/// OpenCL for CPUs, is switched on before the first device is opened, unless GLOAM_ONE_OPENCL is set in the environment.
Device& device(const std::string& text = "");
/// Whether there is such a device.
bool has_device(const std::string& text);

/// Plans and runs; returns the planes asked for.
Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 const std::string& device_name = "");

/// Those of a technique's extras that its estimate makes, without those that a filter of its own completes.
std::vector<std::string> unfiltered_extras(const Technique& technique);

/// Adds invented planes that a technique reads for extras alone.
void invent_for_extras(const Technique& technique, Frame& frame);

/// Whether a test looks only at what layers and eyes add to a technique: all else is the text of the technique that it is a variant of.
/// Never in a long run.
bool is_only_variant(const Technique& technique);

/// Name for a test: letters, digits and underscores, "hbao_plus".
std::string identifier(const std::string& name);

}  // namespace gloam::test
