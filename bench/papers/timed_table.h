// A paper's table of times: its rows run in turn, each over the base of its column.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/papers/study.h"
#include "bench/timing.h"

namespace gloam::bench {

/// Counts the passes of these names, whichever technique's they are.
std::function<bool(const std::string& pass)> passes_named(const std::vector<std::string>& names);

/// The sum over the passes that count, run by run: of one view, or of all where none is named.
Series series_of(const TimedPlan& timed, const std::function<bool(const std::string& pass)>& counts,
                 const std::string& view = {});

/// One row of one column, and what of its passes counts. Those that ask for the same of the same stage share their runs.
struct Entry {
  std::string row, column;
  Asked asked;
  const Stage* stage;
  std::optional<double> paper = {};  ///< milliseconds
  bool is_base = false;              ///< of its column, or of all where no other is
  std::function<bool(const std::string& pass)> counts = [](const std::string&) { return true; };
  std::string view = {};  ///< that counts; empty: all
};

/// A part of the passes whose time is stated by itself too.
struct Part {
  std::string name;
  std::function<bool(const std::string& pass)> counts;
};

struct TimedTable {
  std::string name, base;  ///< base: what the ratios are to, in words
  std::string parts_name;  ///< of the table of parts
  std::vector<Part> parts = {};
};

/// Runs the entries in turn, and states each one's time over that of the base of its column (or of the first base).
void measure(Study& study, const TimedTable& table, const std::vector<Entry>& entries);

}  // namespace gloam::bench
