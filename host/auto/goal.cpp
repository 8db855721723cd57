#include "planner/goal.h"

#include "base/lists.h"
#include "gloam/auto.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

void check_goal(const Goal& goal, const AutoPlan& planned) {
  if (!goal) return;
  check_one_goal(goal);
  if (planned.facts.is_of_display)
    throw UsageError(
        "{}: weighs effects by the picture of one camera, and a light-field display has many; leave it out",
        in_words(goal));
  for (const Unfit& each : planned.unfit) {
    if (each.plane == "color")
      throw Error(
          "{}: needs the frame's colour to tell what effects change in it, and color is unfit: {}; {} has it taken",
          in_words(goal), each.why, channels_option("color", "CHANNELS"));
  }
  if (!contains(planned.facts.planes, "color"))
    throw UsageError(
        "{0}: needs the frame's colour to tell what effects change in it, and {1} has none; name it with {2}, or leave "
        "{0} out",
        in_words(goal), planned.facts.name, channels_option("color", "LAYER"));
}

std::string note_on_goal(const Spent& spent, const Goal& goal) {
  if (!spent.is_missed) return "";
  if (goal.error)
    return fmt::format("{}: no choice is expected to reach it; the nearest, {:.4f}, was taken", in_words(goal),
                       spent.expected_error);
  return fmt::format(
      "{}: nothing fits, so all effects were left out; looking takes {:.2f} ms, and with the cheapest, {}, it is "
      "{:.2f} ms",
      in_words(goal), spent.glance_ms, spent.cheapest, spent.cheapest_ms);
}

}  // namespace gloam
