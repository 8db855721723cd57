// Compiled kernels on disk, for drivers that do not keep them by themselves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gloam/device.h"

namespace gloam {

/// A folder with one file for each compiled program. A file names what it was compiled from and for, and holds a hash of the
/// program, so that a stale or damaged file is noticed before a driver gets it. Threads and processes may share a folder.
class KernelCache {
 public:
  /// An empty path: nothing is found and nothing is kept.
  explicit KernelCache(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  /// The program kept under a key: the source, the options, the device and its driver. A file that is damaged, or another key's,
  /// is removed, and counts as damaged.
  std::optional<std::string> find(const std::string& key) const;
  /// Keeps a program. Does nothing where it cannot be written: kept programs save time and nothing else.
  void keep(const std::string& key, const std::string& program) const;
  /// Removes a program that the driver does not take; it counts as damaged.
  void remove(const std::string& key) const;

  struct Check {
    int kept = 0, damaged = 0;
  };
  /// Reads all files, and removes those that are damaged.
  Check check() const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path path_of(const std::string& key) const;
  std::filesystem::path folder_;
};

/// That of this user, below `cache_folder`.
KernelCache own_kernel_cache();

/// Whether no compiled kernel is kept for a device, as before its first run. False for a driver that keeps them where gloam does not know.
bool keeps_no_kernels_yet(const DeviceInfo& device);

/// How many kept programs this process found damaged, in one sentence; empty: none.
std::string damaged_kernels_note();

}  // namespace gloam
