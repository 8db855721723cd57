// Measurements as results of bench.json (docs/benchmarking.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measure/measurement.h"
#include "results/fields.h"

namespace gloam::bench {

using Json = nlohmann::ordered_json;

/// "model name" of /proc/cpuinfo; "unknown" if there is none.
std::string cpu_model();

/// Results without a figure: where they are measured (device, cpu, cores, driver, date, commit, version and command).
report::Measurements results_on(const DeviceInfo& device);

/// The median, the least and the greatest of times; 0 for none.
report::Milliseconds times_of(const Series& ms);
/// The same with every round, and the interval of the median.
report::Milliseconds times_and_rounds(const Series& ms);

report::Reads reads_of(const Technique& technique);

/// What is known of a scene before anything is measured on it.
report::Scene scene_of(const std::string& name, const std::string& scene_class, const std::string& effect,
                       const Frame& frame, const Radius& radius);

report::Measurements results_of(const Measurement& measurement, const MeasureOptions& options,
                                const DeviceInfo& device);

}  // namespace gloam::bench
