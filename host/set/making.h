// Makes the files of a set.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "set/manifest.h"
#include "set/recipe.h"

namespace gloam::sets {

struct MakeOptions {
  std::filesystem::path folder;
  std::vector<std::string> only;  ///< names of items; empty: all
  std::optional<uint64_t> seed;   ///< of a seeded part
  std::string gloam, commit;      ///< for the manifest
  /// "courtyard: ao", and which share of all work is done.
  std::function<void(const std::string& what, double share)> progress = {};
  std::function<void(const SetItem& item, double seconds)> item_done = {};
};

/// A file that has another content than the frozen one.
struct Difference {
  std::string file, expected, got, cause;
};

struct MakeResult {
  Manifest manifest;
  int made = 0, kept = 0;  ///< files
  std::vector<Difference> differences;
  std::vector<std::string> missing;   ///< items of the recipe that the folder lacks
  std::vector<std::string> unfrozen;  ///< items without frozen hashes
};

/// Makes what the folder lacks of the items: files that were made before, of the same recipe and with the frozen content, stay. The
/// manifest is written after each item, so that an interrupted run goes on where it stopped; a truth even within its image. Throws
/// Error for a folder that holds another set.
MakeResult make_set(const Recipe& recipe, const MakeOptions& options);

/// "Embree 3.13.5, glibc 2.36": what decides on the last bits besides gloam.
std::string libraries_in_words();

}  // namespace gloam::sets
