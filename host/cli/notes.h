// What a command says on standard error beside its results: notes and progress. --quiet turns both off.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace gloam::cli {

/// -q, --quiet
void add_quiet_flag(CLI::App& command);
bool is_quiet();

/// Keeps notes (what was assumed) for the end of the command; a command that fails says why it failed and nothing else.
void note(const std::vector<std::string>& notes);
/// Without repetitions.
std::vector<std::string> notes_so_far();
/// The notes on standard error, one line each; none with --quiet.
void print_notes();

/// Whether standard error is a terminal, where progress is written over what was there, and --quiet was not given.
bool shows_progress();

/// Draws a bar on standard error once the work has taken a second; empty where no progress is shown.
std::function<void(int done, int of)> progress_bar();

}  // namespace gloam::cli
