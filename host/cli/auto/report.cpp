#include <cmath>

#include "cli/auto/command.h"
#include "cli/flags/options.h"

namespace gloam::cli {
namespace {

std::string milliseconds_or_dash(double ms) { return std::isnan(ms) ? "-" : fmt::format("{:.2f}", ms); }

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

const char* wanted_in_words(const Outcome& o) {
  if (o.is_left_out) return "left out";
  return o.decision.effect.is_wanted ? "yes" : "no";
}

Explanation explanation_of(const EffectChoice& choice, const std::string& view) {
  Explanation e{.effect = choice.technique->effect.name, .where = where_in_words(choice), .why = choice.why};
  // What was not probed could not be computed.
  if (choice.is_wanted)
    e.wanted = Explanation::Wanted::yes;
  else if (choice.cells.empty())
    e.wanted = Explanation::Wanted::impossible;
  if (!choice.cells.empty()) e.cells = choice.seen->view(view).find(choice.cells);
  e.is_everywhere = choice.is_everywhere;
  return e;
}

std::string technique_of(const Outcome& outcome) {
  if (outcome.is_left_out || !outcome.plan) return "";
  return fmt::format("{}, {:.1f} ms", outcome.runs() ? runs_in_words(outcome) : "looked for", outcome.ms);
}

std::string in_percent(double share) {
  return share < 0.001  ? "less than .1 %"
         : share < 0.01 ? fmt::format("{:.1f} %", 100 * share)
                        : fmt::format("{:.0f} %", 100 * share);
}

/// "changes the picture by 12 % of its RMS, and takes 8.1 ms; its best option is expected to differ from this one by 3 % of the RMS"
std::string says_of(const Outcome& o, double picture_rms) {
  if (std::isnan(o.change) || !(picture_rms > 0)) return "";
  const std::string change = in_percent(o.change / picture_rms);
  if (!o.runs()) return fmt::format("would change the picture by {} of its RMS", change);
  std::string says = fmt::format("changes the picture by {} of its RMS, and takes {:.1f} ms", change, o.ms);
  if (!std::isnan(o.lost))
    says += fmt::format("; its best option is expected to differ from this one by {} of the RMS",
                        in_percent(o.lost / picture_rms));
  return says;
}

}  // namespace

std::vector<Explanation> explanations_of(const AutoResult& result, const std::string& view) {
  std::vector<Explanation> all;
  for (const Outcome& outcome : result.outcomes) {
    Explanation& effect = all.emplace_back(explanation_of(outcome.decision.effect, view));
    if (outcome.is_left_out) effect.wanted = Explanation::Wanted::no;
    effect.says = says_of(outcome, result.picture_rms);
    if (const auto part = outcome.parts.find(view); part != outcome.parts.end()) effect.part = &part->second;
    effect.technique = technique_of(outcome);
    effect.saved = saved_in_words(outcome);
    effect.lost = lost_in_words(outcome);
    const auto change = outcome.changes.find(view);
    if (change != outcome.changes.end()) effect.change = &change->second;
    for (const EffectChoice& refinement : outcome.decision.refinements) {
      Explanation& e = all.emplace_back(explanation_of(refinement, view));
      if (outcome.is_left_out && e.wanted == Explanation::Wanted::yes)
        e.wanted = Explanation::Wanted::no;
      else if (refinement.is_wanted)
        e.technique = "runs as " + refinement.technique->name;
    }
  }
  return all;
}

void print(const AutoResult& result, const Goal& goal) {
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
  if (result.spent && !result.spent->why.empty()) fmt::print("{}\n", result.spent->why);
}

}  // namespace gloam::cli
