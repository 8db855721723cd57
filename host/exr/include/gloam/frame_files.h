// The frame that a command works on: one file, or two files with an eye each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/history.h"

namespace gloam {

/// The view that a file's name ends in: "left" for "truth_left.exr". None if it ends in no view's name.
std::optional<std::string> view_in_name(const std::filesystem::path& file, const std::vector<std::string>& views);

/// A frame from one file, as `FrameFile` reads it, or from two files with one view each: a frame of two views, in the order given.
/// Both files are read with the same options, each by itself: its depth convention, the space of its normals. The frame's window
/// covers both windows.
///
/// The eyes get their views' names if the files name both, and differently. Otherwise the file names decide (`pair_L.exr`,
/// `pair-right.0012.exr`), else they are "left" and "right" in the order given; `Frame::assumed` says so. In a camera JSON, an
/// eye's camera is the one of its name; the single camera of a JSON that belongs to both files is neither's.
///
/// Throws UsageError for no file, for more than two, for one file twice, and with two files for a file of several views and for
/// `ReadOptions::views`; Error for two display windows that differ, and for an eye whose camera has no pose. Also throws as
/// `FrameFile` does.
class FrameFiles {
 public:
  FrameFiles(const std::vector<std::string>& paths, const ReadOptions& options);

  /// Adds the planes of a history to the frame from now on. Throws as `History` does.
  void take_history(const std::filesystem::path& path) { history_.emplace(path); }
  const std::optional<History>& history() const { return history_; }
  /// From now on the planes of a history count as the frame's: the caller adds them to what `read` returns.
  void expect_history() { expects_history_ = true; }

  const std::vector<FrameFile>& files() const { return files_; }
  /// "pair_L.exr and pair_R.exr", without folders.
  std::string name() const;
  Window window() const { return files_.front().window(); }
  const std::vector<std::string>& views() const { return views_; }
  /// As `FrameFile::common_planes`, over the views of all files.
  std::vector<std::string> common_planes() const;
  /// As `FrameFile::why_missing`.
  std::string why_missing(const std::string& plane) const;
  /// As `FrameFile::read`. An assumption about one of two files is noted with its name.
  Frame read(const std::vector<std::string>& planes);

 private:
  std::vector<PlaneSource> sources() const;
  Frame read_files(const std::vector<std::string>& planes);

  std::vector<FrameFile> files_;
  std::vector<std::string> views_;
  std::optional<History> history_;
  bool expects_history_ = false;
  std::string assumed_;  ///< how the eyes got their names; empty if the files name them
};

}  // namespace gloam
