// Whether a folder holds the set that its manifest names, file by file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "set/manifest.h"

namespace gloam::sets {

/// One thing that is wrong, for one line.
struct Problem {
  std::string file;     ///< relative to the folder
  std::string problem;  ///< "is missing", "was changed: its content is ... and the manifest says ..."
};

struct Verification {
  Manifest manifest;
  int files = 0;  ///< that the manifest names
  std::vector<Problem> problems;
  std::vector<std::string> missing;   ///< items of the set that the folder lacks
  std::vector<std::string> unfrozen;  ///< items whose hashes are not frozen, so that the manifest's alone were compared
};

/// Compares contents with the manifest, and those of a public part with the frozen hashes; finds missing files, and files that the
/// manifest does not name. Throws Error for a folder without a readable manifest, and for a set that is not known.
Verification verify_set(const std::filesystem::path& folder,
                        const std::function<void(int done, int of)>& progress = {});

}  // namespace gloam::sets
