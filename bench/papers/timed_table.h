// A paper's table of times: its rows run in turn, each over the base of its column.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/timing.h"
#include "papers/study.h"

namespace gloam::bench {

/// A filter for passes with these names, of any technique.
std::function<bool(const std::string& pass)> passes_named(const std::vector<std::string>& names);

/// The sum over the passes that count, run by run: of one view, or of all if none is named.
Series series_of(const TimedPlan& timed, const std::function<bool(const std::string& pass)>& counts,
                 const std::string& view = {});

/// One row of one column, and which of its passes count. Entries that ask for the same on the same stage share their runs.
struct Entry {
  std::string row, column;
  Asked asked;
  const Stage* stage;
  std::optional<double> paper = {};  ///< milliseconds
  bool is_base = false;              ///< base of its column, or of all columns without one
  std::function<bool(const std::string& pass)> counts = [](const std::string&) { return true; };
  std::string view = {};  ///< view that counts; empty: all
};

/// A part of the passes whose time is also stated separately.
struct Part {
  std::string name;
  std::function<bool(const std::string& pass)> counts;
};

struct TimedTable {
  std::string name, base;  ///< base: text for what the ratios are to
  std::string parts_name;  ///< name of the table of parts
  std::vector<Part> parts = {};
};

/// Runs the entries in turn, and states each one's time relative to the base of its column (or to the first base).
void measure(Study& study, const TimedTable& table, const std::vector<Entry>& entries);

}  // namespace gloam::bench
