// The flags that were given to a command.
#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

namespace gloam::cli {

/// The name of a flag, with dashes, or of a positional argument.
std::string flag_of(const CLI::Option& option);

/// Those given, in the order of `--help`.
std::vector<const CLI::Option*> options_given(const CLI::App& command, const std::set<std::string>& left_out);

/// The flags given that decide what the file of a frame holds, for `FrameMaking`: " --set radius=0.5 --preset medium".
std::string contents_in_words(const CLI::App& command);

}  // namespace gloam::cli
