// A folder among the temporary files, or beside what is made in it, removed at the end.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// A new folder that nobody else has. The destructor removes it with all that is in it, and so does the handler of
/// `remove_temporaries_on_signal`. Folders of the same kind that killed processes of this user have left there are removed when one is
/// made.
class TemporaryFolder {
 public:
  /// `kind`: in its name, "gloam-KIND-XXXXXX". Throws Error if it cannot be made.
  explicit TemporaryFolder(const std::string& kind);
  /// In a folder of any other place: "PREFIXXXXXXX".
  TemporaryFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace gloam
