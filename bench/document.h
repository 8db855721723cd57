// bench.json (docs/benchmarking.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measurement.h"

namespace gloam::bench {

using Json = nlohmann::ordered_json;

/// "model name" of /proc/cpuinfo; "unknown" where there is none.
std::string cpu_model();

/// `rays`: per pixel, of truths that are traced.
Json document_of(const Measurement& measurement, const MeasureOptions& options, int rays, const DeviceInfo& device);

}  // namespace gloam::bench
