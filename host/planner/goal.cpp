#include "planner/goal.h"

#include "base/numbers.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

const std::string frames_per_second = "fps";

/// Seconds of a frame of "60fps"; none for another form.
std::optional<double> seconds_of_frame(const std::string& text) {
  if (!text.ends_with(frames_per_second)) return {};
  const std::optional<double> rate = number_in<double>(text.substr(0, text.size() - frames_per_second.size()));
  return rate && *rate >= 1e-6 && *rate <= 1e9 ? std::optional(1 / *rate) : std::nullopt;
}

}  // namespace

Goal time_goal(const std::string& text, const std::string& flag) {
  if (const std::optional<double> seconds = seconds_of_frame(text)) return {.ms = 1e3 * *seconds, .per_second = text};
  if (const std::optional<double> seconds = seconds_in(text)) return {.ms = 1e3 * *seconds};
  throw UsageError("{} {} is not allowed; {}, or frames per second, such as 60fps", flag, text, allowed_times);
}

std::string in_words(const Goal& goal) {
  if (!goal.ms) return option("error", fmt::format("{:g}", *goal.error));
  if (goal.per_second.empty()) return option("budget", fmt::format("{:g}", *goal.ms)) + "ms";
  return fmt::format("{} ({:.4g} ms)", option("budget", goal.per_second), *goal.ms);
}

std::string bound_in_words(const Goal& goal, const std::string& error) {
  if (!goal.ms) return fmt::format("within {} {:g}", error, *goal.error);
  if (goal.per_second.empty()) return fmt::format("within {:g} ms", *goal.ms);
  return fmt::format("within {:.4g} ms, for {}", *goal.ms, goal.per_second);
}

void check_one_goal(const Goal& goal) {
  if (goal.ms && goal.error)
    throw UsageError("{} and {} are both given; give one of them", option("budget"), option("error"));
}

void check_has_goal(const Goal& goal, const std::string& command) {
  check_one_goal(goal);
  if (!goal)
    throw UsageError("{}: give either {}, a time such as 20ms or 60fps, or {}, such as 0.02", command, option("budget"),
                     option("error"));
}

}  // namespace gloam
