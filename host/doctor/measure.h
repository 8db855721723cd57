// Measures which lane width and which group size suit a device.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/device.h"

namespace gloam::doctor {

/// A tuning and its time on the device.
struct Timed {
  Tuning tuning;
  double ms = 0;
};

struct Measurement {
  Tuning best;               ///< the usual one, unless another is faster by more than noise
  std::vector<Timed> timed;  ///< the fastest first
};

/// Times the raw AO of a technique on an image of 960 x 540: first the usual number of lanes and its neighbours, then each group size with the best of those.
/// Each is compiled anew where it is not kept, so the first measurement on a device takes several times as long as the next.
/// `goes_on` is called between steps. Throws as `run` does.
Measurement measure_tuning(const std::string& technique, Device& device, const std::function<void()>& goes_on);

}  // namespace gloam::doctor
