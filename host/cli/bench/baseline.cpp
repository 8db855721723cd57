#include "cli/bench/baseline.h"

#include <algorithm>

#include "cli/report/compare.h"
#include "gloam/error.h"
#include "report/comparison_page.h"

namespace gloam::cli {
namespace {

using report::ComparedRow;
using report::ErrorVerdict;
using report::TimeVerdict;

template <typename Condition>
std::vector<std::string> rows_that(const report::Comparison& comparison, const Condition& is_it) {
  std::vector<std::string> names;
  for (const ComparedRow& row : comparison.rows) {
    if (is_it(row)) names.push_back(report::words(row.name));
  }
  return names;
}

/// "3 rows slower (gtao medium on courtyard, ...)"
std::string told(const std::vector<std::string>& names, const std::string& what) {
  constexpr size_t most = 3;
  if (names.empty()) return "";
  const std::vector<std::string> shown(names.begin(), names.begin() + std::ptrdiff_t(std::min(most, names.size())));
  return fmt::format("{} {} ({}{})", counted(names.size(), "row"), what, fmt::join(shown, "; "),
                     names.size() > most ? "; ..." : "");
}

/// Techniques that are slower as a whole count too, where no single row of them is sure.
std::vector<std::string> slower_techniques(const report::Comparison& comparison) {
  std::vector<std::string> names;
  for (const report::ComparedTechnique& t : comparison.techniques) {
    if (t.time == TimeVerdict::slower) names.push_back(fmt::format("{} {:+.1f} %", t.technique, 100 * t.change->value));
  }
  return names;
}

/// What is worse, a part of a sentence each.
std::vector<std::string> worse_in(const report::Comparison& comparison, bool times, bool errors) {
  std::vector<std::string> worse;
  if (times) {
    const std::vector<std::string> slower = slower_techniques(comparison);
    if (!slower.empty()) worse.push_back("slower as a whole: " + enumerate(slower));
    worse.push_back(
        told(rows_that(comparison, [](const ComparedRow& r) { return r.time == TimeVerdict::slower; }), "slower"));
  }
  if (errors)
    worse.push_back(
        told(rows_that(comparison, [](const ComparedRow& r) { return r.error == ErrorVerdict::farther; }), "farther"));
  std::erase(worse, "");
  return worse;
}

void note_noise(const report::Comparison& comparison) {
  const size_t noisy =
      rows_that(comparison, [](const ComparedRow& r) { return r.time == TimeVerdict::too_noisy; }).size();
  if (noisy > 0)
    note(
        {fmt::format("{} too noisy to tell within {:g} %: measure both in more processes (--processes 5), with more "
                     "techniques beside the one in question, or on a quieter machine",
                     counted(noisy, "row"), 100 * comparison.options.margin)});
}

}  // namespace

ComparedWithBaseline compare_with_baseline(const report::Source& baseline, const std::filesystem::path& file) {
  const report::Source now = result_of(file.string());
  return {baseline, now, report::compare(baseline, now)};
}

void tell(const ComparedWithBaseline& compared, Regression regression, bool quiet) {
  const report::Comparison& comparison = compared.comparison;
  const std::string &before = compared.before.name, &now = compared.now.name;
  note(comparison.notes);
  if (!quiet) print(comparison, compared.before, compared.now);
  note_noise(comparison);
  const bool times = regression != Regression::error, errors = regression != Regression::time;
  if (times && comparison.reference.empty())
    throw Error("{}: times cannot be compared with it: {}; --regression error fails on errors alone", before,
                comparison.notes.empty() ? "no rounds" : comparison.notes.back());
  const std::vector<std::string> worse = worse_in(comparison, times, errors);
  if (worse.empty()) return;
  print_notes();  // an error leaves them out
  throw Error("worse than {}: {}; gloam report {} {} --compare --markdown FILE.md shows all rows", before,
              fmt::join(worse, ", "), quoted_for_shell(before), quoted_for_shell(now));
}

}  // namespace gloam::cli
