// Notes and progress of a command on standard error. --quiet turns both off.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gloam::cli {

/// -q, --quiet
void add_quiet_flag(CLI::App& command);
bool is_quiet();

/// Keeps notes (assumptions) for the end of the command, from any thread. A command that fails prints its error only.
void note(const std::vector<std::string>& notes);
/// The notes, without repetitions.
std::vector<std::string> notes_so_far();
/// An object with the notes so far as "notes", unless it has some.
nlohmann::ordered_json noted(nlohmann::ordered_json document);
/// Prints the notes on standard error, one line each; none with --quiet.
void print_notes();

/// Whether standard error is a terminal, on which progress can be overwritten, and --quiet was not given.
bool shows_progress();

/// Draws a bar on standard error once the work has taken a second; empty if no progress is shown.
std::function<void(int done, int of)> progress_bar();

}  // namespace gloam::cli
