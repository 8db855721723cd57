// gloam bench --baseline FILE: what is slower or farther from the truth than before.
#pragma once

#include "cli/bench/request.h"
#include "report/comparison.h"

namespace gloam::cli {

/// A result beside its baseline.
struct ComparedWithBaseline {
  report::Source before, now;
  report::Comparison comparison;
};

ComparedWithBaseline compare_with_baseline(const report::Source& baseline, const std::filesystem::path& file);

/// Prints the comparison, unless `quiet`. Throws Error if a row is worse in what `regression` names, and where times were to be
/// compared and cannot be.
void tell(const ComparedWithBaseline& compared, Regression regression, bool quiet);

}  // namespace gloam::cli
