#include "cli/bench/processes.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/files.h"
#include "base/json_text.h"
#include "base/statistics.h"
#include "base/temporary_folder.h"
#include "cli/bench/subjects.h"
#include "cli/process/children.h"
#include "gloam/error.h"
#include "measure/intervals.h"

namespace gloam::cli {
namespace {

using Rounds = std::vector<double>;

/// What says that two rows are the same.
std::string key_of(const Json& row) {
  Json name = Json::array();
  for (const char* key : {"technique", "preset", "variant", "scene", "effect", "width", "height"})
    name.push_back(row.value(key, Json()));
  return name.dump();
}

Json interval_of(const Rounds& rounds) {
  const std::optional<bench::Interval> interval = bench::interval_of_median(rounds);
  return interval ? Json{interval->low, interval->high} : Json(nullptr);
}

void append(Json& rounds, const Json& more) { rounds.insert(rounds.end(), more.begin(), more.end()); }

void join_milliseconds(Json& ms, const Json& other) {
  if (!ms.is_object() || !other.is_object()) return;
  append(ms["rounds"], other.at("rounds"));
  const Rounds rounds = ms["rounds"];
  const auto [least, most] = std::minmax_element(rounds.begin(), rounds.end());
  ms["median"] = median(rounds);
  ms["min"] = *least;
  ms["max"] = *most;
  ms["interval"] = interval_of(rounds);
}

/// Every "..._rounds" of a row, with the ratio and the interval that are made of it.
void join_ratios(Json& row, const Json& other) {
  const std::string ending = "_rounds";
  std::vector<std::string> ratios;
  for (const auto& [key, value] : row.items()) {
    if (key.size() > ending.size() && key.ends_with(ending) && other.contains(key))
      ratios.push_back(key.substr(0, key.size() - ending.size()));
  }
  for (const std::string& ratio : ratios) {
    append(row[ratio + ending], other.at(ratio + ending));
    const Rounds rounds = row[ratio + ending];
    row[ratio + "_interval"] = interval_of(rounds);
    if (row.contains(ratio) && !rounds.empty()) row[ratio] = median(rounds);
  }
}

void join_row(Json& row, const Json& other) {
  if (!row.contains("processes")) row["processes"] = {row.at("ms").at("rounds").size()};
  row["processes"].push_back(other.at("ms").at("rounds").size());
  join_milliseconds(row["ms"], other.at("ms"));
  join_milliseconds(row["cpu_ms"], other.at("cpu_ms"));
  join_ratios(row, other);
}

Json measured_by_process(const MoreProcesses& more, int number) {
  constexpr double a_day = 86400;
  const TemporaryFolder own(more.folder, ".gloam-process-");
  const std::filesystem::path folder = own.path();
  std::filesystem::create_directory_symlink("../scenes", folder / "scenes");  // frames and truths of the first
  std::vector<std::string> words = more.repeated;
  for (const std::string& word :
       {std::string("--output"), folder.string(), std::string("--rows"), (more.folder / "bench.json").string(),
        std::string("--rounds"), std::to_string(more.rounds), std::string("--processes"), std::string("1")})
    words.push_back(word);
  const ChildEnd end = run_child(words, a_day, [](const std::string&) {});
  if (end.status != 0)
    throw Error("process {} of {} failed: {}; {} holds what was measured before", number, more.processes,
                end.ended_by.empty() ? last_line_of(end) : end.ended_by, (more.folder / "bench.json").string());
  const std::filesystem::path file = folder / "bench.json";
  return ordered_json_of_text(read_text(file), file.string());
}

}  // namespace

void join_rounds(Json& document, const Json& other) {
  std::map<std::string, const Json*> rows;
  for (const Json& row : other.at("results")) rows[key_of(row)] = &row;
  for (Json& row : document.at("results")) {
    const auto again = rows.find(key_of(row));
    if (again != rows.end()) join_row(row, *again->second);
  }
  document["processes"] = document.value("processes", 1) + 1;
}

void measure_in_more_processes(const MoreProcesses& more, Json& document) {
  for (int number = 2; number <= more.processes; ++number) {
    show_status(fmt::format("process {} of {}", number, more.processes), double(number - 1) / more.processes);
    join_rounds(document, measured_by_process(more, number));
  }
  erase_status();
}

const std::set<std::string>& not_of_further_processes() {
  static const std::set<std::string> flags = {
      "--output", "--json",    "--rows",      "--baseline",  "--regression", "--processes",
      "--rounds", "--effects", "--scenes",    "--presets",   "--techniques", "--variants",
      "--sweep",  "--ladder",  "--no-growth", "--no-checks", "--no-images",  "--google-benchmark"};
  return flags;
}

}  // namespace gloam::cli
