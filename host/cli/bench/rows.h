// gloam bench --rows FILE and --baseline FILE: the rows of an earlier result, measured again.
#pragma once

#include "cli/bench/request.h"
#include "measure/measurement.h"
#include "results/joined.h"

namespace gloam::cli {

/// Flags as if given for the file's techniques, scenes, effects, size, radius and rays; flags that were given stay. `rows` gets the
/// file's rows. Throws Error for a file whose rows cannot be measured again, with what to do.
BenchCommand flags_for_rows(BenchCommand flags, const report::Source& source, std::vector<bench::WantedRow>& rows);

/// Adds --rows, --baseline, --regression and --processes.
void add_rows_flags(CLI::App& app, BenchCommand& flags);

}  // namespace gloam::cli
