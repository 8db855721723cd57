#include "planner/goal.h"

#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

std::string in_words(const Goal& goal) {
  return goal.ms ? option("budget", fmt::format("{:g}", *goal.ms)) + "ms"
                 : option("error", fmt::format("{:g}", *goal.error));
}

std::string bound_in_words(const Goal& goal, const std::string& error) {
  return goal.ms ? fmt::format("within {:g} ms", *goal.ms) : fmt::format("within {} {:g}", error, *goal.error);
}

void check_one_goal(const Goal& goal) {
  if (goal.ms && goal.error)
    throw UsageError("{} and {} are both given; give one of them", option("budget"), option("error"));
}

void check_has_goal(const Goal& goal, const std::string& command) {
  check_one_goal(goal);
  if (!goal)
    throw UsageError("{}: give either {}, a time such as 20 ms, or {}, such as 0.02", command, option("budget"),
                     option("error"));
}

}  // namespace gloam
