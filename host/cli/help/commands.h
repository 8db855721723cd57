// The commands that people see, in groups by what a person wants: `gloam --help`, its man pages, errors and completion read this table.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gloam::cli {

struct Command {
  std::string name;
  void (*add)(CLI::App&);
};

struct CommandGroup {
  std::string wanted;  ///< heading of `gloam --help`
  std::vector<Command> commands;
};

const std::vector<CommandGroup>& command_groups();

/// In the order of the table.
std::vector<std::string> command_names();

/// Adds all of them under their headings.
void add_commands(CLI::App& app);

}  // namespace gloam::cli
