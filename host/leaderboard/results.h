// The result files of one folder: what `gloam bench`, `gloam score` and `gloam stress` wrote.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "results/joined.h"

namespace gloam::leaderboard {

using report::HeldCases;
using report::Source;

/// Result files of one set, or of none. Items of different sets are different images, so nothing is compared across boards.
struct Board {
  report::SetFacts set;
  std::vector<size_t> files;  ///< indices into Results::files
};

/// A device's hard cases.
struct Stability {
  std::string file, device;
  std::map<std::string, HeldCases> techniques;
};

struct Results {
  std::vector<Source> files;
  std::vector<Board> boards;
  std::vector<Stability> stability;
};

/// Reads FOLDER/*.json and FOLDER/*/bench.json, in order of their names. Throws Error, in one line that names the file: for a folder
/// without results, a damaged file, a file that is something else, and two files of one set whose hashes differ.
Results read_results(const std::filesystem::path& folder);

/// "gloam-1", "gloam-1, seeded part (seed 7)", "frames without a set"
std::string title_of(const report::SetFacts& set);

}  // namespace gloam::leaderboard
