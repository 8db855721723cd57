#include "cli/auto/report.h"

#include <cmath>

#include "cli/flags/options.h"

namespace gloam::cli {
namespace {

std::string milliseconds_or_dash(double ms) { return std::isnan(ms) ? "-" : fmt::format("{:.2f}", ms); }

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

const char* wanted_in_words(const Outcome& o) {
  if (o.is_left_out) return "left out";
  return o.decision.effect.is_wanted ? "yes" : "no";
}

}  // namespace

void print(const AutoResult& result, const BudgetGoal& goal) {
  std::vector<std::vector<std::string>> rows = {
      {"effect", "wanted", "where", "runs", "ms", "masked", "everywhere", "saved", "lost", "why"}};
  for (const Outcome& o : result.outcomes) {
    const EffectChoice& effect = o.decision.effect;
    const bool is_possible = o.plan || o.is_left_out;
    rows.push_back({effect.technique->effect.name, wanted_in_words(o), where_in_words(effect),
                    or_dash(runs_in_words(o)), is_possible ? milliseconds_or_dash(o.ms) : "",
                    is_possible ? milliseconds_or_dash(o.ms_masked) : "",
                    is_possible ? milliseconds_or_dash(o.ms_everywhere) : "", or_dash(saved_in_words(o)),
                    or_dash(lost_in_words(o)), effect.why});
    for (const EffectChoice& r : o.decision.refinements)
      rows.push_back({r.technique->effect.name, r.is_wanted ? "yes" : "no", where_in_words(r), r.technique->name, "",
                      "", "", "", "", r.why});
  }
  print_table(rows, rows.front().size());
  fmt::print("{}\n", totals_in_words(result, goal));
}

}  // namespace gloam::cli
