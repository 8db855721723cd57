// The flags of a command as given, in words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gloam::cli {

/// Those that decide what the file of a frame holds: "--set radius=0.5 --preset medium".
std::string contents_in_words(const CLI::App& command);

}  // namespace gloam::cli
