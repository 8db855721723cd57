// The names of a sequence's files, with a place for the frame's number: "shots/shot.####.exr", "shots/shot.%04d.exr".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Each # stands for a digit; %d and %04d are as in C. Shorter numbers are filled up with zeros, longer ones keep their digits.
/// The number has its place in the file's name, not in a folder's.
class FramePattern {
 public:
  /// Whether a path has a place for a number. A file that exists under the very name has none.
  static bool is_pattern(const std::string& path);

  /// Throws UsageError, beginning with `flag`, for a path without a place for a number, with two, or with one in a folder's name.
  FramePattern(const std::string& path, const std::string& flag);

  /// As given.
  const std::string& text() const { return text_; }
  /// The file's name without folders, as given.
  std::string name() const { return std::filesystem::path(text_).filename().string(); }
  /// "." if the pattern names no folder.
  std::filesystem::path folder() const;
  /// The same for all spellings of one pattern in a folder: "shot.####.exr" for "shot.%04d.exr".
  std::string normal_name() const;

  std::filesystem::path path_of(int frame) const;
  /// The frame of a file's name without folders; none if it is no file of this sequence.
  std::optional<int> frame_of(const std::string& file_name) const;
  /// The frames whose files are there, in ascending order. Throws Error if the folder cannot be read.
  std::vector<int> frames_there() const;

 private:
  std::string text_, before_, after_;  ///< the file's name before and after the number
  int digits_ = 0;
};

}  // namespace gloam
