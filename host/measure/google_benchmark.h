// A result in the form of Google Benchmark's JSON (docs/benchmarking.md).
#pragma once

#include <nlohmann/json.hpp>

namespace gloam::bench {

/// Each round of a row as an iteration, and mean, median, standard deviation and their ratio as aggregates. `document`: bench.json.
nlohmann::ordered_json google_benchmark_of(const nlohmann::ordered_json& document);

}  // namespace gloam::bench
