#include "measure/processes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/child_process.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/statistics.h"
#include "base/temporary_folder.h"
#include "gloam/error.h"
#include "measure/intervals.h"
#include "measure/timing.h"
#include "results/fields.h"

namespace gloam::bench {
namespace {

using report::Milliseconds;

/// What says that two rows are the same.
auto key_of(const report::Row& row) {
  return std::tuple(row.technique, row.preset, row.variant, row.scene, row.effect, row.width, row.height);
}

Series ends_of_interval(const Series& rounds) {
  const std::optional<Interval> interval = interval_of_median(rounds);
  return interval ? Series{interval->low, interval->high} : Series();
}

/// Appends rounds; false where one of the two has none.
bool join(Series& rounds, Series& interval, const Series& more) {
  if (rounds.empty() || more.empty()) return false;
  rounds.insert(rounds.end(), more.begin(), more.end());
  interval = ends_of_interval(rounds);
  return true;
}

void join(Milliseconds& ms, const Milliseconds& more) {
  if (!join(ms.rounds, ms.interval, more.rounds)) return;
  const auto [least, most] = std::minmax_element(ms.rounds.begin(), ms.rounds.end());
  ms.median = median(ms.rounds), ms.min = *least, ms.max = *most;
}

void join(report::RoundRatios& rounds, report::Number& ratio, const report::RoundRatios& more) {
  join(rounds.cpu, rounds.cpu_interval, more.cpu);
  if (join(rounds.ms, rounds.ms_interval, more.ms) && ratio) ratio = median(rounds.ms);
}

void join(report::Row& row, const report::Row& more) {
  if (row.processes.empty()) row.processes = {double(row.ms.rounds.size())};
  row.processes.push_back(double(more.ms.rounds.size()));
  join(row.ms, more.ms);
  if (row.cpu_ms && more.cpu_ms) join(*row.cpu_ms, *more.cpu_ms);
  join(row.hbao_plus_rounds, row.ratio_to_hbao_plus, more.hbao_plus_rounds);
  join(row.gather_floor_rounds, row.ratio_to_gather_floor, more.gather_floor_rounds);
  join(row.copy_floor_rounds, row.ratio_to_copy_floor, more.copy_floor_rounds);
}

/// The results of another process, as its file has them.
report::Measurements measured_by_process(const MoreProcesses& more, int number) {
  constexpr double a_day = 86400;
  const TemporaryFolder own(more.folder, ".gloam-process-");
  const std::filesystem::path folder = own.path(), before = more.folder / "bench.json";
  std::filesystem::create_directory_symlink("../scenes", folder / "scenes");  // frames and truths of the first
  std::vector<std::string> words = more.repeated;
  words.insert(words.end(), {"--output", folder.string(), "--rows", before.string(), "--rounds",
                             std::to_string(more.rounds), "--processes", "1"});
  const ChildEnd end = run_child(words, a_day, [](const std::string&) {});
  if (end.status != 0)
    throw Error("process {} of {} failed: {}; {} holds what was measured before", number, more.processes,
                end.ended_by.empty() ? last_line_of(end) : end.ended_by, before.string());
  const std::string file = (folder / "bench.json").string();
  const report::Json document = ordered_json_of_text(read_text(file), file);
  return report::read<report::Measurements>(JsonObject(document, {file}));
}

}  // namespace

void measure_in_more_processes(const MoreProcesses& more, report::Measurements& results) {
  for (int number = 2; number <= more.processes; ++number) {
    more.progress(fmt::format("process {} of {}", number, more.processes), double(number - 1) / more.processes);
    const report::Measurements other = measured_by_process(more, number);
    std::map<decltype(key_of(report::Row())), const report::Row*> rows;
    for (const report::Row& row : other.rows) rows[key_of(row)] = &row;
    for (report::Row& row : results.rows) {
      if (const auto again = rows.find(key_of(row)); again != rows.end()) join(row, *again->second);
    }
  }
}

}  // namespace gloam::bench
