#include "cli/process/chunk_commands.h"

#include <cstdio>
#include <filesystem>

#include "base/command_line.h"
#include "flags/typed.h"
#include "gloam/error.h"
#include "sequence/chunks.h"

namespace gloam::cli {
namespace {

/// The path of this program.
std::string program_path() {
  std::error_code unknown;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return unknown ? "gloam" : path.string();
}

}  // namespace

void add_chunk_flags(CLI::App& app, int& chunks, bool& print, const std::string& what, const std::string& group) {
  CLI::Option* printing =
      app.add_flag("--print", print, "with --chunks: print the commands, one a line, and compute nothing")
          ->group(group);
  add_number(app, "--chunks", chunks, {1, 1000000},
             "divide " + what + " into so many commands, for several processes or machines", "N")
      ->group(group)
      ->needs(printing);
  printing->needs(app.get_option("--chunks"));
}

std::string flag_of(const CLI::Option& option) {
  return (option.nonpositional() ? "--" : "") + option.get_single_name();
}

std::vector<const CLI::Option*> options_given(const CLI::App& command, const std::set<std::string>& left_out) {
  return command.get_options(
      [&](const CLI::Option* option) { return option->count() > 0 && left_out.count(flag_of(*option)) == 0; });
}

std::vector<std::string> repeated_words(const CLI::App& command, std::set<std::string> left_out) {
  left_out.insert({"--chunks", "--print", "--help"});
  std::vector<std::string> words = {command.get_name()};
  for (const CLI::Option* option : options_given(command, left_out)) {
    const bool takes_value = option->get_items_expected_max() > 0;
    if (!takes_value) words.push_back(flag_of(*option));
    for (const std::string& value : takes_value ? option->results() : std::vector<std::string>()) {
      if (option->nonpositional()) words.push_back(flag_of(*option));
      words.push_back(value);
    }
  }
  return words;
}

void print_chunk(const std::vector<std::string>& words, const std::vector<std::string>& more) {
  std::vector<std::string> all = {program_path()};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), more.begin(), more.end());
  fmt::print("cd {} && {}\n", quoted_for_shell(std::filesystem::current_path().string()), shell_line(all));
}

void end_of_chunks() {
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
}

}  // namespace gloam::cli
