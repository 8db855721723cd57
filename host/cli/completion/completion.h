// Completion of `gloam` in shells, from the command's own table of commands and flags, and from the registry.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

namespace gloam::cli {

/// Possible values of a flag or argument.
struct Completion {
  std::vector<std::string> words;
  bool has_files = false;
  std::string ending;    ///< ending of the files, with the dot; empty: any
  bool is_list = false;  ///< several words, separated by commas
};

struct CompletedFlag {
  std::vector<std::string> names;  ///< "-o", "--output"
  std::string help;                ///< one line, without text in brackets
  std::string type;                ///< "OUT.exr"; empty for a switch, which takes no value
  Completion value;
};

struct CompletedArgument {
  std::string name;
  Completion value;
};

struct CompletedCommand {
  std::string name, help;
  std::vector<CompletedFlag> flags;
  std::vector<CompletedArgument> arguments;
  /// The flags of parameters of techniques and built-in scenes, by their names.
  std::vector<std::pair<std::string, std::vector<CompletedFlag>>> parameters;
};

/// What the first word may be.
struct CompletedWords {
  std::vector<CompletedCommand> commands;
  std::vector<std::string> techniques;  ///< each stands for `run` with it
};

std::string bash_completion(const CompletedWords& first);
std::string zsh_completion(const CompletedWords& first);

/// Names of parameters that a command takes as flags.
using ParameterFlags = std::set<std::string> (*)(const CLI::App*);

/// `gloam completion bash|zsh`, which `gloam --help` does not show.
void add_completion(CLI::App& app, ParameterFlags parameter_flags);

}  // namespace gloam::cli
