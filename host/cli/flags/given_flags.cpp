#include "cli/flags/given_flags.h"

#include <fmt/format.h>

#include <set>

#include "cli/process/chunk_commands.h"
#include "sequence/frame_making.h"

namespace gloam::cli {
namespace {

/// Flags that do not change what the file of a frame holds, or of which its header says more (the files read).
const std::set<std::string> not_of_contents = {"frame",          "other_eye", "--camera",  "--output",    "--into",
                                               "--picture",      "--json",    "--frames",  "--missing",   "--resume",
                                               "--memory",       "--repeat",  "--warm-up", "--composite", "--quiet",
                                               "--limit-memory", "--help",    "technique"};

}  // namespace

std::string contents_in_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options_given(command, not_of_contents)) {
    words += " " + flag_of(*option);
    for (const std::string& value : option->results()) words += " " + with_hash_of_file(value);
  }
  return words;
}

}  // namespace gloam::cli
