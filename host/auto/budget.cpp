#include "auto/budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "auto/option_times.h"
#include "base/lists.h"
#include "base/statistics.h"

namespace gloam {
namespace {

/// More rounds than options of one effect are never needed; this bounds a device whose times jump.
constexpr int most_rounds = 24;

/// One round of measuring: what was measured on the frame, and by how much the table was wrong.
class Spending {
 public:
  Spending(std::vector<BudgetedEffect>& effects, const BudgetMeans& means, OptionSpeeds& speeds)
      : effects_(effects), means_(means), speeds_(speeds), times_(effects.size()), corrections_(effects.size(), 1) {}

  ChoiceProblem problem() const {
    const Glance& glance = means_.glance;
    ChoiceProblem problem{.model = glance.model(), .looking_ms = means_.looking_ms};
    problem.uses = glance.uses();
    for (size_t i = 0; i < effects_.size(); ++i) {
      problem.effects.emplace_back();
      for (size_t k = 0; k < effects_[i].options.size(); ++k)
        problem.effects.back().push_back(
            {effects_[i].options[k].planes_on(glance.seen()), ms_with_its_part(i, int(k))});
    }
    return problem;
  }

  /// Runs what is chosen and was not run yet. Whether there was any.
  bool run_chosen(const Choice& choice) {
    bool any = false;
    for (size_t i = 0; i < effects_.size(); ++i) {
      BudgetedEffect& effect = effects_[i];
      if (choice.options[i] == left_out) {
        effect.chosen = left_out;
        effect.result = {};
        continue;
      }
      if (times_[i].count(choice.options[i]) && effect.chosen == choice.options[i]) continue;
      any = true;
      effect.chosen = choice.options[i];
      run_one(i);
    }
    return any;
  }

 private:
  double ms_of(size_t effect, int option) const {
    const auto measured = times_[effect].find(option);
    if (measured != times_[effect].end()) return measured->second;
    return effects_[effect].expected_ms[size_t(option)] * corrections_[effect];
  }

  /// What completes an effect takes no less than the effect alone, however noisy the times are.
  double ms_with_its_part(size_t effect, int option) const {
    const std::vector<EffectOption>& options = effects_[effect].options;
    double ms = ms_of(effect, option);
    if (options[size_t(option)].request.outputs.size() == 1) return ms;
    for (size_t k = 0; k < options.size(); ++k) {
      const bool is_its_part =
          options[k].request.outputs.size() == 1 && options[k].setting() == options[size_t(option)].setting();
      if (is_its_part) ms = std::max(ms, ms_of(effect, int(k)));
    }
    return ms;
  }

  void take(BudgetedEffect& effect, Plan plan, RunResult result, bool is_masked) {
    effect.ms = median(result.total_ms);
    effect.result = std::move(result);
    effect.plan = std::move(plan);
    effect.is_masked = is_masked;
  }

  void run_one(size_t i) {
    BudgetedEffect& effect = effects_[i];
    const EffectOption& option = effect.options[size_t(effect.chosen)];
    Plan plan = make_plan(option.request, means_.available, means_.holds);
    RunResult result = timed(option, plan, means_.frame, means_);
    const double everywhere = median(result.total_ms);
    take(effect, std::move(plan), std::move(result), false);
    speeds_.add(option.label(), size_of(means_.frame), everywhere);
    corrections_[i] = everywhere / std::max(effect.expected_ms[size_t(effect.chosen)], 1e-6);
    if (!effect.mask.empty() && !option.is_seen) try_mask(effect, option);
    // The slower of two times is kept, so that noise does not make a choice go round in circles.
    double& kept = times_[i][effect.chosen];
    kept = std::max(kept, effect.ms);
  }

  void try_mask(BudgetedEffect& effect, const EffectOption& option) {
    PlanRequest request = option.request;
    request.only = effect.mask;
    request.elsewhere = effect.elsewhere;
    Plan plan = make_plan(request, means_.available, means_.holds);
    RunResult result = timed(plan, means_.frame, means_);
    if (means_.always_masked || median(result.total_ms) <= most_of_everywhere * effect.ms)
      take(effect, std::move(plan), std::move(result), true);
  }

  std::vector<BudgetedEffect>& effects_;
  const BudgetMeans& means_;
  OptionSpeeds& speeds_;
  std::vector<std::map<int, double>> times_;  ///< by effect, measured on the frame
  std::vector<double> corrections_;           ///< by effect: measured over expected
};

Choice choose_for(const Goal& goal, const ChoiceProblem& problem, bool& is_missed) {
  const std::optional<Choice> best = best_within(problem, goal);
  is_missed = !best;
  return best ? *best : nearest_miss(problem, goal);
}

void name_cheapest(const std::vector<BudgetedEffect>& effects, const ChoiceProblem& problem, Spent& spent) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < effects.size(); ++i) {
    for (size_t k = 0; k < effects[i].options.size(); ++k) {
      const double ms = problem.effects[i][k].ms;
      if (ms >= least) continue;
      least = ms;
      spent.cheapest = fmt::format("{} by {}", effects[i].technique->effect.name, effects[i].options[k].label());
    }
  }
  spent.cheapest_ms = spent.glance_ms + (effects.empty() ? 0 : least);
}

/// "evidence, medium, half + sssr, low, full"
std::string label_of(const std::vector<BudgetedEffect>& effects, const std::vector<int>& options) {
  std::vector<std::string> labels;
  for (size_t i = 0; i < effects.size(); ++i)
    if (options[i] != left_out) labels.push_back(effects[i].options[size_t(options[i])].label());
  return labels.empty() ? "no effect" : fmt::format("{}", fmt::join(labels, " + "));
}

/// How far the planes of the choice are from those of the best option.
double lost_by(const BudgetedEffect& effect, const Glance& glance) {
  if (effect.chosen == left_out) return effect.change;
  const EffectOption& option = effect.options[size_t(effect.chosen)];
  std::vector<UsedPlane> planes = used_among(option.planes_on(glance.seen()), glance.uses());
  for (UsedPlane& plane : planes) plane.kept = 1 - plane.kept;
  return std::sqrt(mean_square_change(glance.model(), planes));
}

/// What the picture changes by an effect's planes, by any of its options.
double change_by(const BudgetedEffect& effect, const Glance& glance) {
  std::vector<std::string> planes;
  for (const EffectOption& option : effect.options) add_new(planes, option.makes);
  return glance.change_by(planes);
}

}  // namespace

Spent spend(std::vector<BudgetedEffect>& effects, const Goal& goal, const BudgetMeans& means, OptionSpeeds& speeds) {
  for (BudgetedEffect& effect : effects) effect.change = change_by(effect, means.glance);
  expect_times(effects, means, speeds);
  Spent spent;
  Spending spending(effects, means, speeds);
  Choice choice;
  for (int round = 0; round < most_rounds; ++round) {
    choice = choose_for(goal, spending.problem(), spent.is_missed);
    if (!spending.run_chosen(choice)) break;
  }
  const ChoiceProblem problem = spending.problem();
  spent.glance_ms = problem.looking_ms;
  spent.why =
      why_chosen(problem, choice, goal, [&](const std::vector<int>& options) { return label_of(effects, options); });
  name_cheapest(effects, problem, spent);
  const bool any = std::any_of(effects.begin(), effects.end(), [](const auto& e) { return e.chosen != left_out; });
  if (goal.ms && !any && !effects.empty() && spent.cheapest_ms > *goal.ms) spent.is_missed = true;
  for (BudgetedEffect& effect : effects) effect.lost = lost_by(effect, means.glance);
  speeds.keep();
  return spent;
}

}  // namespace gloam
