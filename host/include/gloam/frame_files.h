// The frame that a command works on: one file, or two files that are an eye each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/history.h"

namespace gloam {

/// The view that a file's name ends in: "truth_left.exr" is of "left". None where it ends in none.
std::optional<std::string> view_in_name(const std::filesystem::path& file, const std::vector<std::string>& views);

/// One file as `FrameFile` reads it, or two files of one view each, which become one frame of two views, in the order
/// given. Each of the two is read by itself, with the same options: what its depth means, the space of its normals. The
/// frame's window covers the windows of both.
///
/// The eyes have the names of their views where the files name both, and differently. Else the names of the files tell
/// (`pair_L.exr`, `pair-right.0012.exr`), else they are "left" and "right" in the order given; that is said in
/// `Frame::assumed`. In a camera JSON an eye's camera is the one of its name; a JSON that belongs to both files and has a
/// single camera is neither's.
///
/// Throws UsageError for no file or more than two, for one file twice, for a file of several views where there are two,
/// and for `ReadOptions::views` then; Error for two display windows that differ, and an eye whose camera has no pose.
/// And whatever `FrameFile` throws.
class FrameFiles {
 public:
  FrameFiles(const std::vector<std::string>& paths, const ReadOptions& options);

  /// The frame has its planes too from now on. Throws what `History` throws.
  void take_history(const std::filesystem::path& path) { history_.emplace(path); }
  const std::optional<History>& history() const { return history_; }

  const std::vector<FrameFile>& files() const { return files_; }
  /// "pair_L.exr and pair_R.exr", without folders.
  std::string name() const;
  Window window() const { return files_.front().window(); }
  const std::vector<std::string>& views() const { return views_; }
  /// As `FrameFile::common_planes`, over the views of all files.
  std::vector<std::string> common_planes() const;
  /// As `FrameFile::why_missing`.
  std::string why_missing(const std::string& plane) const;
  /// As `FrameFile::read`. What was assumed for one of two files alone is said with its name.
  Frame read(const std::vector<std::string>& planes);

 private:
  std::vector<PlaneSource> sources() const;
  Frame read_files(const std::vector<std::string>& planes);

  std::vector<FrameFile> files_;
  std::vector<std::string> views_;
  std::optional<History> history_;
  std::string assumed_;  ///< how the eyes got their names; empty where the files say them
};

}  // namespace gloam
