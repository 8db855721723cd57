// A folder for files that another program makes, beside the place where they go: what is there stays until the new files are.
#pragma once

#include <filesystem>

namespace gloam::cli {

/// Removed at its end with all that is left in it, and by the next one beside it if this process is killed.
class MakingFolder {
 public:
  /// Throws Error if it cannot be made.
  explicit MakingFolder(const std::filesystem::path& beside);
  ~MakingFolder();
  MakingFolder(const MakingFolder&) = delete;
  MakingFolder& operator=(const MakingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Moves a file of the folder to a name outside, in place of what is there. False if there is no such file.
  bool hand_over(const std::filesystem::path& name, const std::filesystem::path& to) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;  ///< held as long as the folder is in use
};

}  // namespace gloam::cli
