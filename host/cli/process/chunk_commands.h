// A command divided into chunks, each a command of its own: --chunks N --print.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

namespace gloam::cli {

/// Adds --chunks, which needs --print, and --print, which needs --chunks. `what`: what is divided.
void add_chunk_flags(CLI::App& app, int& chunks, bool& print, const std::string& what, const std::string& group);

/// The name of a flag, with dashes, or of a positional argument.
std::string flag_of(const CLI::Option& option);

/// Flags and arguments given, in the order of `--help`.
std::vector<const CLI::Option*> options_given(const CLI::App& command, const std::set<std::string>& left_out);

/// The words of a command that does the same as this one, without these flags and those about chunks.
std::vector<std::string> repeated_words(const CLI::App& command, std::set<std::string> left_out);

/// Prints a command, one line, with its folder and this program: `words` and `more`. Any shell may run it.
void print_chunk(const std::vector<std::string>& words, const std::vector<std::string>& more);

/// Call it after the last command. Throws Error if standard output did not take all.
void end_of_chunks();

}  // namespace gloam::cli
