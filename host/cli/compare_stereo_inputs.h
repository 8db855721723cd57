// The files that gloam compare --stereo reads: results of both eyes, and the frame they were made from.
#pragma once

#include <string>
#include <vector>

#include "cli/compare_stereo.h"

namespace gloam::cli {

struct StereoInput {
  FrameFile file;
  Frame frame;

  std::string name() const { return file.path().string(); }
  /// Those of the named planes that the file has.
  void read(const std::vector<std::string>& wanted) {
    std::vector<std::string> planes;
    for (const std::string& plane : wanted) {
      if (contains(file.common_planes(), plane)) planes.push_back(plane);
    }
    frame = file.read(planes);
  }
};

/// The file with both views, or that of each eye.
std::vector<StereoInput> open_results(const CompareFlags& flags, const ReadOptions& options);
/// That of --frame, if any.
std::vector<StereoInput> open_frame(const CompareFlags& flags, const ReadOptions& options);
/// Planes of both eyes as they are read, and once more as they are compared.
unsigned long long bytes_of(const std::vector<StereoInput>& results, const std::vector<StereoInput>& frames,
                            std::vector<std::string> geometry, const std::string& plane);
/// Reads of each file what it has of the geometry, and a plane.
void read_all(std::vector<StereoInput>& inputs, std::vector<std::string> geometry, const std::string& plane);
/// The plane asked for. A point's depth is another for each eye, so that depths are not compared.
std::string plane_asked_for(const std::vector<StereoInput>& results, const std::string& asked);
/// The first that all files have, results before inputs.
std::string plane_to_compare(const std::vector<StereoInput>& results);

}  // namespace gloam::cli
