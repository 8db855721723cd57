// Measures which lane width, which group sizes and which limit of registers suit a device.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gloam/device.h"

namespace gloam::doctor {

/// A tuning and its times on the device, milliseconds: of the kernels that read far around each pixel, and of the others.
struct Timed {
  Tuning tuning;
  double ms = 0, ms_of_others = 0;
};

/// A tuning's object (run/tuning.h), with "ms" and "ms_of_others".
nlohmann::ordered_json document_of(const Timed& timed);

struct Measurement {
  Tuning best;               ///< the usual one, but for what is faster by more than noise
  std::vector<Timed> timed;  ///< the fastest first
};

/// Times a technique's AO, with its filter, on an image of 960 x 540: first the usual number of lanes and its neighbours, then each group size
/// with the best of those, for either kind of kernel; where the driver takes a limit of registers, then such limits, with the technique that
/// needs the most. Each is compiled anew where it is not kept, so the first measurement on a device takes several times as long as the next.
/// `goes_on` is called between steps. Throws as `run` does.
Measurement measure_tuning(const std::string& technique, Device& device, const std::function<void()>& goes_on);

}  // namespace gloam::doctor
