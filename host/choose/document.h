// What a contest came to, as `gloam pick --json` writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "choose/pick.h"
#include "gloam/device.h"

namespace gloam::bench {

/// "full", "half" or "quarter".
std::string resolution_of(const Variation& variation);

/// The best finalist's "technique", "preset", "resolution", "ms", "rmse", "ssim" (and "flip"), then "device", "error_to", "by",
/// "finalists", "skipped" and "left_out".
nlohmann::ordered_json document_of(const Picked& picked, PickBy by, const DeviceInfo& device);

/// What to tell where errors are to a stand-in for the truth.
std::string stand_in_warning(const Picked& picked);

}  // namespace gloam::bench
