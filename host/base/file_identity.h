// Which file a path leads to, whatever it is called: through links and other spellings, and also where it does not exist yet.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace gloam {

/// The file that a path leads to through symbolic links, which stay, even if the last one leads to nothing. Of a
/// circle of links one of them.
std::filesystem::path follow_links(const std::filesystem::path& path);

struct FileIdentity {
  /// The absolute path after all links: the same for all spellings, and before and after the file and its folder are made.
  std::string place;
  /// Device and inode of the file; none if it does not exist. Hard links have one and different places.
  std::optional<std::pair<dev_t, ino_t>> file;
};

FileIdentity identity_of(const std::filesystem::path& path);

/// Whether two names lead to one file, or would once it exists.
bool are_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace gloam
