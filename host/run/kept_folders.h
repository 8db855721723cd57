// Folders for what is kept from one process to the next: gloam's own, and those of drivers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Where gloam keeps compiled kernels and what `gloam doctor` found.
struct CacheFolder {
  std::filesystem::path folder;  ///< exists, can be written, and by nobody else; empty: nothing can be kept
  std::string why_elsewhere;     ///< why it is not the usual folder; empty: it is
};

/// GLOAM_CACHE_DIR, else XDG_CACHE_HOME/gloam, else HOME/.cache/gloam, else a folder of this user among the temporary files. Looked
/// for once in a process.
const CacheFolder& cache_folder();

/// The text of a file that was kept; none if there is none, or something else that cannot have been kept: a pipe, a link, a file of somebody
/// else's. Never waits.
std::optional<std::string> kept_text(const std::filesystem::path& file);

/// Before a file is kept: removes a pipe, a link, or an empty folder of its name, which nobody can have kept there.
void make_way(const std::filesystem::path& file);

/// While the platforms are asked for: PoCL then makes an empty file in its folder to see whether it can, and leaves it there. The destructor
/// removes it, and files that processes left when they were killed while they compiled.
class PoclLeftovers {
 public:
  PoclLeftovers();
  ~PoclLeftovers();
  PoclLeftovers(const PoclLeftovers&) = delete;
  PoclLeftovers& operator=(const PoclLeftovers&) = delete;

 private:
  std::vector<std::string> before_;
};

/// Where compiled kernels go instead of folders in which somebody else could put code, in one sentence that names these; empty: all folders
/// are this user's alone. For a command that has opened a device.
std::string foreign_folders_note();

}  // namespace gloam
