#include "auto/goal.h"

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam {
std::string in_words(const BudgetGoal& goal) {
  return goal.ms ? fmt::format("--budget {:g}ms", *goal.ms) : fmt::format("--error {:g}", *goal.error);
}

void check_goal(const BudgetGoal& goal, const AutoPlan& planned) {
  if (!goal) return;
  const std::string flag =
      goal.ms ? fmt::format("--budget {:g}ms", *goal.ms) : fmt::format("--error {:g}", *goal.error);
  if (planned.facts.is_of_display)
    throw UsageError(
        "{}: weighs effects by the picture of one camera, and a light-field display has many; leave it out", flag);
  for (const Unfit& each : planned.unfit) {
    if (each.plane == "color")
      throw Error(
          "{}: needs the frame's colour to tell what effects change in it, and color is unfit: {}; --plane "
          "color=CHANNELS has it taken",
          flag, each.why);
  }
  if (!contains(planned.facts.planes, "color"))
    throw UsageError(
        "{}: needs the frame's colour to tell what effects change in it, and {} has none; name it with "
        "--plane color=LAYER, or leave the flag out",
        flag, planned.facts.name);
}

std::string note_on_goal(const Spent& spent, const BudgetGoal& goal) {
  if (!spent.is_missed) return "";
  if (goal.error)
    return fmt::format("{}: no choice is expected to reach it; the nearest, {:.4f}, was taken", in_words(goal),
                       spent.expected_error);
  return fmt::format(
      "--budget {:g}ms: nothing fits, so all effects were left out; looking takes {:.2f} ms, and with the "
      "cheapest, {}, it is {:.2f} ms",
      *goal.ms, spent.glance_ms, spent.cheapest, spent.cheapest_ms);
}

}  // namespace gloam
