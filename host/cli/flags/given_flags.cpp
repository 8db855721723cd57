#include "cli/flags/given_flags.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "base/files.h"
#include "base/hash.h"
#include "cli/process/chunk_commands.h"

namespace gloam::cli {
namespace {

/// Flags that do not change what the file of a frame holds, or of which its header says more (the files read).
const std::set<std::string> not_of_contents = {"frame",          "other_eye", "--camera",  "--output",    "--into",
                                               "--picture",      "--json",    "--frames",  "--missing",   "--resume",
                                               "--memory",       "--repeat",  "--warm-up", "--composite", "--quiet",
                                               "--limit-memory", "--help",    "technique"};

/// A flag's value; a parameter that is a file, coefficients=FILE, with a hash of what the file holds.
std::string value_in_words(const std::string& value) {
  const size_t equals = value.find('=');
  const std::string file = equals == std::string::npos ? "" : value.substr(equals + 1);
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return value;
  return fmt::format("{} ({:016x})", value, hash_of(read_text(file)));
}

}  // namespace

std::string contents_in_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options_given(command, not_of_contents)) {
    words += " " + flag_of(*option);
    for (const std::string& value : option->results()) words += " " + value_in_words(value);
  }
  return words;
}

}  // namespace gloam::cli
