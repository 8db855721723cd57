#include "planner/plan_option.h"

#include <fmt/format.h>

#include "run/run_words.h"

namespace gloam {

std::string PlanOption::label() const { return fmt::format("{}, {}", fmt::join(request.outputs, " + "), setting()); }

std::string PlanOption::setting() const {
  return fmt::format("{}, {}{}{}", request.preset.empty() ? "default" : request.preset,
                     word_for(request.resolution, resolution_words), request.temporal ? ", temporal" : "",
                     is_seen ? ", from the look" : "");
}

}  // namespace gloam
