// What gloam bench prints of its measurements.
#pragma once

#include "cli/bench/request.h"
#include "measure/tables.h"

namespace gloam::cli {

void print(const bench::Table& table);

/// A line for each reason, with all techniques and scenes that it holds for.
void print_skipped(const std::vector<bench::Skipped>& skipped);

/// Tables of all scenes, what was skipped and what a time limit left out.
void print(const bench::Measurement& result, const BenchOptions& options, const DeviceInfo& device);

}  // namespace gloam::cli
