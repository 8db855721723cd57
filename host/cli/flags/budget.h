// The flag --budget: a time, or frames per second.
#pragma once

#include <string>

#include "flags/typed.h"
#include "gloam/goal.h"

namespace gloam::cli {

/// An error that is given beside it stays in the goal.
inline CLI::Option* add_budget(CLI::App& app, Goal& goal, const std::string& help) {
  const CLI::callback_t take = [&goal](const CLI::results_t& texts) {
    const Goal time = time_goal(texts.front(), "--budget");
    goal.ms = time.ms;
    goal.per_second = time.per_second;
    return true;
  };
  return app.add_option("--budget", take, help)->type_name("TIME");
}

}  // namespace gloam::cli
