// Figures of `gloam compare`, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "cli/compare/inputs.h"
#include "gloam/metrics.h"

namespace gloam::cli {

Json metrics_document(const Metrics& metrics);

/// "ao: ao.exr against truth.exr", or "ao_raw of ao.exr against ao of truth.exr".
void print_heading(const PlanePair& planes, const CompareFlags& flags);

void print_metrics(const std::string& view, const std::string& plane, const Metrics& metrics);

}  // namespace gloam::cli
