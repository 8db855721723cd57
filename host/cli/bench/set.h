// gloam bench --set DIR: gloam's own techniques on the items of a frozen set, with the figures that gloam score gives others.
#pragma once

#include <functional>
#include <vector>

#include "cli/bench/request.h"

namespace gloam::cli {

/// Rows of an earlier result, measured again.
struct RowsOfSet {
  std::vector<bench::WantedRow> rows;  ///< none: all that the flags ask for
  std::function<void(Json&)>
      complete;  ///< completes the document before it is written to --json; bench.json is there by then
};

/// Measures every item with the techniques that make its effects, and writes bench.json after each. Rows that gloam score added to the
/// same set's bench.json stay. Throws Error for a folder with results of another set, UsageError for flags that a set does not take.
void bench_set(const BenchCommand& flags, Device& device, const RowsOfSet& again = {});

}  // namespace gloam::cli
