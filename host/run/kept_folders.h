// Folders for what is kept from one process to the next: gloam's own, and PoCL's.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// Where gloam keeps compiled kernels and what `gloam doctor` found.
struct CacheFolder {
  std::filesystem::path folder;  ///< exists and can be written; empty: nothing can be kept
  std::string why_elsewhere;     ///< why it is not the usual folder; empty: it is
};

/// GLOAM_CACHE_DIR, else XDG_CACHE_HOME/gloam, else HOME/.cache/gloam, else a folder of this user among the temporary files. Looked
/// for once in a process.
const CacheFolder& cache_folder();

}  // namespace gloam
