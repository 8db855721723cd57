#include "cli/auto/explanations.h"

#include "auto/report.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

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
  if (outcome.is_left_out) return "left out";
  if (!outcome.plan) return "";
  return fmt::format("{}, {:.1f} ms", outcome.runs() ? runs_in_words(outcome) : "looked for", outcome.ms);
}

}  // namespace

std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view) {
  std::vector<Explanation> all;
  for (const Outcome& outcome : outcomes) {
    Explanation& effect = all.emplace_back(explanation_of(outcome.decision.effect, view));
    effect.technique = technique_of(outcome);
    effect.saved = saved_in_words(outcome);
    effect.lost = lost_in_words(outcome);
    const auto change = outcome.changes.find(view);
    if (change != outcome.changes.end()) effect.change = &change->second;
    for (const EffectChoice& refinement : outcome.decision.refinements) {
      Explanation& e = all.emplace_back(explanation_of(refinement, view));
      if (refinement.is_wanted) e.technique = "runs as " + refinement.technique->name;
    }
  }
  return all;
}

}  // namespace gloam::cli
