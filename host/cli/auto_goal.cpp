#include "cli/auto_goal.h"

#include <array>
#include <utility>

#include "base/lists.h"
#include "cli/typed.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

constexpr std::array<std::pair<const char*, double>, 3> units = {{{"us", 1e-3}, {"ms", 1}, {"s", 1e3}}};

bool ends_in(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

double parse_budget(const std::string& text, const std::string& flag) {
  for (const auto& [unit, ms] : units) {
    if (!ends_in(text, unit)) continue;
    const std::string number = text.substr(0, text.size() - std::string(unit).size());
    return parse_number(number, flag, Range<double>{1e-6, 1e9}) * ms;
  }
  throw UsageError("{} {}: is not a time; write a number with its unit, such as 30ms, 0.03s or 500us", flag, text);
}

std::string in_words(const BudgetGoal& goal) {
  return goal.ms ? fmt::format("--budget {:g}ms", *goal.ms) : fmt::format("--error {:g}", *goal.error);
}

void check_goal(const BudgetGoal& goal, const AutoFrame& planned) {
  if (!goal) return;
  const std::string flag =
      goal.ms ? fmt::format("--budget {:g}ms", *goal.ms) : fmt::format("--error {:g}", *goal.error);
  if (is_of_display(planned.files))
    throw UsageError(
        "{}: weighs effects by the picture of one camera, and a light-field display has many; leave it out", flag);
  for (const Unfit& each : planned.unfit) {
    if (each.plane == "color")
      throw Error(
          "{}: needs the frame's colour to tell what effects change in it, and color is unfit: {}; --plane "
          "color=CHANNELS has it taken",
          flag, each.why);
  }
  if (!contains(planned.files.common_planes(), "color"))
    throw UsageError(
        "{}: needs the frame's colour to tell what effects change in it, and {} has none; name it with "
        "--plane color=LAYER, or leave the flag out",
        flag, planned.files.name());
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

}  // namespace gloam::cli
