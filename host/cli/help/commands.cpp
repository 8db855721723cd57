#include "cli/help/commands.h"

#include "cli/flags/options.h"

namespace gloam::cli {

const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> all = {
      {"Compute", {{"run", add_run}, {"auto", add_auto}, {"plan", add_plan}}},
      {"Judge", {{"compare", add_compare}, {"score", add_score}, {"doctor", add_doctor}}},
      {"Choose", {{"pick", add_pick}, {"list", add_list}}},
      {"Make scenes and their truth", {{"capture", add_capture}, {"reference", add_reference}}},
      {"Look", {{"info", add_info}, {"view", add_view}, {"report", add_report}}},
      {"Big jobs", {{"bench", add_bench}, {"leaderboard", add_leaderboard}, {"set", add_set}, {"stress", add_stress}}}};
  return all;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const CommandGroup& group : command_groups())
    for (const Command& command : group.commands) names.push_back(command.name);
  return names;
}

void add_commands(CLI::App& app) {
  for (const CommandGroup& group : command_groups()) {
    for (const Command& command : group.commands) {
      command.add(app);
      app.get_subcommand(command.name)->group(group.wanted);  // throws for a name that the command does not have
    }
  }
}

}  // namespace gloam::cli
