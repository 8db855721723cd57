// Which file of a submission is for which frame, by their names: ITEM[.FRAME][_VIEW][_EFFECT].exr or .png,
// the frame's number also at the end.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "score/target.h"

namespace gloam::score {

/// A file of a submission: for all views of a frame, or for one.
struct SubmittedFile {
  std::filesystem::path path;
  std::string view;  ///< empty: all views
};

/// What a file's name says.
struct NamedFile {
  std::string item, effect, view;
  int frame = 0;  ///< 0: none is named
};

/// None if the name begins with no item, or goes on otherwise. `effect`: of names that state none.
std::optional<NamedFile> parse_image_name(const std::string& stem, const std::vector<Target>& targets,
                                          const std::string& effect);

class SubmittedFiles {
 public:
  /// Files, and folders whose files are taken. Throws Error for a path that is neither, and for folders without an image.
  SubmittedFiles(const std::vector<std::string>& paths, const std::vector<Target>& targets, const std::string& effect);

  /// Those of one frame; of a frame with a file for all views and files of views, the former. None if there are none.
  std::vector<SubmittedFile> files_of(const Target& target, int frame) const;
  /// Whether there is any file of a target.
  bool has(const Target& target) const;
  /// The effects that files are of.
  std::vector<std::string> effects() const;
  /// Images whose names say nothing of a target.
  const std::vector<std::filesystem::path>& unknown() const { return unknown_; }
  size_t size() const { return files_.size(); }

  /// One line that says how the file of a frame is named.
  static std::string name_for(const Target& target, int frame);

 private:
  void add(const std::filesystem::path& path, const std::vector<Target>& targets, const std::string& effect);

  std::vector<std::pair<NamedFile, std::filesystem::path>> files_;
  std::vector<std::filesystem::path> unknown_;
};

}  // namespace gloam::score
