#include "cli/explanations.h"

#include <cmath>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

Explanation explanation_of(const EffectChoice& choice, const std::string& view) {
  Explanation e{.effect = choice.technique->effect.name, .where = where(choice), .why = choice.why};
  // What was not probed could not be computed.
  if (choice.is_wanted)
    e.wanted = Explanation::Wanted::yes;
  else if (choice.cells.empty())
    e.wanted = Explanation::Wanted::impossible;
  if (!choice.cells.empty()) e.cells = choice.seen.view(view).find(choice.cells);
  e.is_everywhere = choice.is_everywhere;
  return e;
}

/// "3.2 of 8.1 ms" of computing everywhere without a look. Empty if nothing was left out, since two times of one computation differ by
/// chance, and where the saving is unknown.
std::string saved(const Outcome& outcome) {
  const bool leaves_out = !outcome.decision.effect.is_wanted || !outcome.decision.request.mask.empty();
  const double ms = outcome.ms_everywhere - outcome.ms;
  return leaves_out && ms > 0 ? fmt::format("{:.1f} of {:.1f} ms", ms, outcome.ms_everywhere) : "";
}

}  // namespace

std::string where(const EffectChoice& choice) {
  if (choice.is_everywhere) return "everywhere";
  if (choice.cells.empty() || choice.share == 0) return "-";
  return choice.share < 0.01 ? "less than 1 %" : fmt::format("{:.0f} %", 100 * choice.share);
}

std::string totals_of(const std::vector<Outcome>& outcomes) {
  double all = 0, looking = 0;
  for (const Outcome& outcome : outcomes) {
    all += outcome.ms;
    looking += outcome.decision.effect.classify_ms;
  }
  return fmt::format("{:.1f} ms for all effects, {:.1f} ms of them to find where the frame calls for them", all,
                     looking);
}

std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view) {
  std::vector<Explanation> all;
  for (const Outcome& outcome : outcomes) {
    Explanation& effect = all.emplace_back(explanation_of(outcome.decision.effect, view));
    if (!outcome.outputs.empty()) {
      const std::string runs =
          effect.wanted == Explanation::Wanted::yes ? outcome.decision.request.outputs.front() : "looked for";
      effect.technique = fmt::format("{}, {:.1f} ms", runs, outcome.ms);
      effect.saved = saved(outcome);
    }
    for (const EffectChoice& refinement : outcome.decision.refinements) {
      Explanation& e = all.emplace_back(explanation_of(refinement, view));
      if (refinement.is_wanted) e.technique = "runs as " + refinement.technique->name;
    }
  }
  return all;
}

}  // namespace gloam::cli
