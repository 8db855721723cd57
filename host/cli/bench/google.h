// gloam bench --google-benchmark FILE: the result in the form of Google Benchmark's JSON (docs/benchmarking.md).
#pragma once

#include <filesystem>

#include "cli/flags/options.h"

namespace gloam::cli {

/// Each round of a row as an iteration, and mean, median, standard deviation and their ratio as aggregates. `document`: bench.json.
Json google_benchmark_of(const Json& document);

void write_google_benchmark(const std::filesystem::path& file, const Json& document);

}  // namespace gloam::cli
