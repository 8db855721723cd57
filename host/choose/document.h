// What a contest came to, as `gloam pick --json` writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "choose/pick.h"
#include "gloam/device.h"

namespace gloam::bench {

/// "full", "half" or "quarter".
std::string resolution_of(const Variation& variation);

/// The best finalist's "technique", "preset", "resolution", "ms", "rmse", "ssim" (and "flip"), then "why", "device", "error_to", "by",
/// "finalists", "skipped" and "left_out".
nlohmann::ordered_json document_of(const Picked& picked, PickBy by, const DeviceInfo& device);

/// What was not tried, and why, in one line; empty where everything was. `left_out`: for want of time, or ruled out by what was tried; `skipped`:
/// what cannot run, or has to be named.
std::string not_tried_in_words(const std::vector<Skipped>& left_out, const std::vector<Skipped>& skipped);

/// What to tell where errors are to a stand-in for the truth.
std::string stand_in_warning(const Picked& picked);

}  // namespace gloam::bench
