// The words of a command line: as people write them, and as the commands take them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gloam::cli {

/// A technique for a command, `gloam ao frame.exr`, is `gloam run ao frame.exr`; `gloam help run` is `gloam run --help`.
std::vector<std::string> completed_words(std::vector<std::string> words);

/// Whether a word names a technique, or a plane that one makes by default ("ao").
bool names_technique(const std::string& word);

/// Whether a word names a frame: a file that is there, an EXR file, or a shot.
bool names_frame(const std::string& word);

/// Where the first word is no command: what was probably meant, as a sentence.
std::string meant_by_first_word(const std::string& word);

/// Where the command lacks its frame, since the first of its two words is one: what was probably meant; empty elsewhere.
std::string meant_without_technique(const CLI::App& command);

/// What the command cannot go without and was not given, with an example; empty where all is there.
std::string lacking_in_words(const CLI::App& command, const std::string& name);

/// The flag that was given more often than it can be; empty where there is none.
std::string repeated_in_words(const CLI::App& command, const std::string& name);

/// Throws UsageError where a frame has the place of the technique.
void check_order(const std::string& command, const std::string& technique, const std::string& frame);

}  // namespace gloam::cli
