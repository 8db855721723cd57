#include "cli/bench/print.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"
#include "measure/document.h"

namespace gloam::cli {

using namespace gloam::bench;

namespace {

/// Techniques with only one preset measured.
std::vector<std::string> measured_in_short(const Measurement& result, const BenchOptions& options) {
  std::vector<std::string> names;
  for (const auto& row : result.rows) {
    if (in_short(*row->variation.technique, options)) add_new(names, row->variation.technique->name);
  }
  return names;
}

/// Measured techniques whose growth was not measured.
std::vector<std::string> without_growth(const Measurement& result, const BenchOptions& options) {
  std::vector<std::string> names;
  for (const auto& row : result.rows) {
    const Technique* t = row->variation.technique;
    if (std::find(options.growth.begin(), options.growth.end(), t) == options.growth.end()) add_new(names, t->name);
  }
  return names;
}

/// "rounds of 12 settings, the ladder of 3": what a time limit left out.
std::string left_out_in_words(const std::vector<LeftOut>& left_out) {
  std::vector<std::string> kinds, words;
  for (const LeftOut& l : left_out) add_new(kinds, l.what);
  for (const std::string& kind : kinds) {
    const auto count =
        std::count_if(left_out.begin(), left_out.end(), [&](const LeftOut& l) { return l.what == kind; });
    const bool is_of_settings = std::any_of(left_out.begin(), left_out.end(),
                                            [&](const LeftOut& l) { return l.what == kind && !l.preset.empty(); });
    const bool is_of_techniques =
        !is_of_settings && std::any_of(left_out.begin(), left_out.end(),
                                       [&](const LeftOut& l) { return l.what == kind && !l.technique.empty(); });
    const char* things = is_of_settings ? "setting" : "technique";
    words.push_back(is_of_settings || is_of_techniques
                        ? fmt::format("{} of {} {}{}", kind, count, things, count == 1 ? "" : "s")
                        : kind);
  }
  return enumerate(words);
}

/// What is skipped for the same reason: `whats` on all of `scenes`, which may be empty.
struct SkippedTogether {
  std::vector<std::string> whats, scenes;
  std::string why;
};

std::vector<SkippedTogether> together(const std::vector<Skipped>& skipped) {
  std::vector<SkippedTogether> by_what, all;
  for (const Skipped& s : skipped) {
    const std::string what = s.preset.empty() ? s.technique : s.technique + " " + s.preset;
    auto same = std::find_if(by_what.begin(), by_what.end(),
                             [&](const SkippedTogether& t) { return t.why == s.why && t.whats.front() == what; });
    if (same == by_what.end()) same = by_what.insert(by_what.end(), {{what}, {}, s.why});
    if (!s.scene.empty()) add_new(same->scenes, s.scene);
  }
  for (const SkippedTogether& each : by_what) {
    const auto same = std::find_if(
        all.begin(), all.end(), [&](const SkippedTogether& t) { return t.why == each.why && t.scenes == each.scenes; });
    if (same == all.end())
      all.push_back(each);
    else
      same->whats.push_back(each.whats.front());
  }
  return all;
}

std::string rounds_in_words(const Measurement& result, const BenchOptions& options) {
  if (!options.limit.is_set() || result.rows.empty()) return fmt::format("{} rounds", options.rounds);
  const auto [fewest, most] = std::minmax_element(
      result.rows.begin(), result.rows.end(), [](const auto& a, const auto& b) { return a->ms.size() < b->ms.size(); });
  return fmt::format("{} to {} rounds", (*fewest)->ms.size(), (*most)->ms.size());
}

}  // namespace

void print(const Table& table) {
  fmt::print("\n{}\n", printable(table.title));
  print_table(table.rows, table.first_number);
  for (const std::string& line : table.below) fmt::print("{}\n", printable(line));
}

void print_skipped(const std::vector<Skipped>& skipped) {
  for (const SkippedTogether& each : together(skipped)) {
    // Of an effect that is not measured there is a scene alone.
    const std::string what = each.whats.front().empty() ? "" : enumerate(each.whats);
    const std::string where = each.scenes.empty() ? "" : (what.empty() ? "" : " on ") + enumerate(each.scenes);
    fmt::print("skipped {}{}: {}\n", what, printable(where), printable(each.why));
  }
}

void print(const Measurement& result, const BenchOptions& options, const DeviceInfo& device) {
  fmt::print("{}, {} ({}); {}\n", cpu_model(), printable(device.name), printable(device.platform),
             rounds_in_words(result, options));
  fmt::print(
      "ms: the whole plan. /hbao+, /floor: over HBAO+ medium, over its own gathers alone. RMSE and bias to the truth.\n"
      "t0w to t5: RMSE of each step to the one before (docs/benchmarking.md). *: no other is as fast\nand as close, "
      "and better in one of the two.\n");
  for (const report::Scene& scene : result.scenes) {
    print(table_of_scene(result, scene));
    if (const Table table = table_of_baselines(result, scene); table.rows.size() > 1 || !table.below.empty())
      print(table);
  }
  if (const std::vector<std::string> names = measured_in_short(result, options); !names.empty())
    fmt::print("\nof {} one preset: --techniques measures those that it names in full\n", enumerate(names));
  if (!result.growth.empty()) {
    print(table_of_growth(result));
    const std::vector<std::string> others = without_growth(result, options);
    if (!others.empty())
      fmt::print("not of {}: --techniques measures the growth of those that it names\n", enumerate(others));
  }
  print_skipped(result.skipped);
  if (!result.left_out.empty())
    fmt::print("\nleft out to end in time: {}; --time 5m measures more, --all everything\n",
               left_out_in_words(result.left_out));
}

}  // namespace gloam::cli
