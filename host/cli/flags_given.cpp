#include "cli/flags_given.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/files.h"
#include "base/hash.h"

namespace gloam::cli {
namespace {

/// Flags that do not change what the file of a frame holds, or of which its header says more (the files read).
const std::set<std::string> not_of_contents = {"frame",    "other_eye", "--camera",       "--output", "--picture",
                                               "--json",   "--frames",  "--missing",      "--resume", "--memory",
                                               "--repeat", "--quiet",   "--limit-memory", "--help",   "technique"};

/// A flag's value; a parameter that is a file, coefficients=FILE, with a hash of what the file holds.
std::string value_in_words(const std::string& value) {
  const size_t equals = value.find('=');
  const std::string file = equals == std::string::npos ? "" : value.substr(equals + 1);
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return value;
  return fmt::format("{} ({:016x})", value, hash_of(read_text(file)));
}

}  // namespace

std::string flag_of(const CLI::Option& option) {
  return (option.nonpositional() ? "--" : "") + option.get_single_name();
}

std::vector<const CLI::Option*> options_given(const CLI::App& command, const std::set<std::string>& left_out) {
  return command.get_options(
      [&](const CLI::Option* option) { return option->count() > 0 && left_out.count(flag_of(*option)) == 0; });
}

std::string contents_in_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options_given(command, not_of_contents)) {
    words += " " + flag_of(*option);
    for (const std::string& value : option->results()) words += " " + value_in_words(value);
  }
  return words;
}

}  // namespace gloam::cli
