// The two eyes of a result: how far they are from each other where both see the same surface.
#pragma once

#include <string>
#include <vector>

#include "base/lists.h"
#include "comparison/files.h"
#include "gloam/stereo_consistency.h"

namespace gloam::comparison {

/// A file of one eye or both, and what was read of it.
struct EyeFile {
  FrameFile file;
  Frame frame;

  std::string name() const { return file.path().string(); }
  /// Reads the named planes, if the file has them.
  void read(const std::vector<std::string>& wanted) {
    std::vector<std::string> planes;
    for (const std::string& plane : wanted) {
      if (contains(file.common_planes(), plane)) planes.push_back(plane);
    }
    frame = file.read(planes);
  }
};

/// Both views of a frame, and how far they are from each other.
struct EyeFigures {
  Frame pair;  ///< with the plane, the depth, the normals if there are any, and the cameras
  std::string plane;
  StereoInconsistency result;
};

/// The files of two eyes, opened.
class TwoEyes {
 public:
  /// `files.reference`: the second eye's, or empty where one file has both views. Values stay as in the files. Throws Error for files that cannot be
  /// read or have other views, and for those without a plane that can be compared.
  TwoEyes(const ComparedFiles& files, ReadOptions options, const StereoOptions& check);

  /// Peak memory of `compare`, bytes: planes of both eyes as they are read, and copies as they are compared.
  unsigned long long bytes() const;
  /// Appends to `notes` what is assumed. Throws Error where depth or cameras of both views are missing.
  EyeFigures compare(std::vector<std::string>& notes);

 private:
  ComparedFiles files_;
  StereoOptions check_;
  std::vector<EyeFile> results_, frames_;
  std::string plane_;
  std::vector<std::string> geometry_ = {"depth"};
};

/// Writes the raw errors of both views, with depth and cameras, as an EXR file. Pixels that do not count are NaN.
void write_errors(const std::string& path, const EyeFigures& figures);

}  // namespace gloam::comparison
