// Locks of the operating system between processes that write into one folder.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gloam {

/// Locks on bytes of a hidden file, which stands for what is locked, from construction to destruction. They end with the process, however
/// it ends, and hold between machines that share the folder. The last process to end removes the file.
class FileLock {
 public:
  /// First and last bytes.
  using Ranges = std::vector<std::pair<int, int>>;

  /// Locks these bytes of the file, which is made where it is not there. `patience`: seconds to wait for another process. Where the
  /// file system has no locks, nothing is locked. Throws Error naming the file if it cannot be made.
  FileLock(const std::filesystem::path& file, const Ranges& bytes, double patience = 0);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool is_held_by_another() const { return descriptor_ < 0; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace gloam
