// Writing bench.json (docs/benchmarking.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measure/measurement.h"

namespace gloam::bench {

using Json = nlohmann::ordered_json;

/// "model name" of /proc/cpuinfo; "unknown" if there is none.
std::string cpu_model();

/// Where a document's figures were measured: device, cpu, cores, driver, date, commit, version and command.
Json origin_of(const DeviceInfo& device);

/// An entry of `scenes`.
Json document_of(const SceneFacts& scene);

Json document_of(const Measurement& measurement, const MeasureOptions& options, const DeviceInfo& device);

}  // namespace gloam::bench
