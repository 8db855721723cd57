// The files that gloam compare --stereo reads: results of both eyes, and the frame they were made from.
#pragma once

#include <string>
#include <vector>

#include "cli/compare/stereo.h"

namespace gloam::cli {

struct StereoInput {
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

/// The file with both views, or the file of each eye.
std::vector<StereoInput> open_results(const CompareFlags& flags, const ReadOptions& options);
/// The file of --frame; empty without it.
std::vector<StereoInput> open_frame(const CompareFlags& flags, const ReadOptions& options);
/// Memory, bytes: planes of both eyes as they are read, and copies as they are compared.
unsigned long long bytes_of(const std::vector<StereoInput>& results, const std::vector<StereoInput>& frames,
                            std::vector<std::string> geometry, const std::string& plane);
/// Reads from each file the planes of `geometry` that it has, and a plane.
void read_all(std::vector<StereoInput>& inputs, std::vector<std::string> geometry, const std::string& plane);
/// The plane asked for. Refuses depth: a point's depth differs between the eyes.
std::string plane_asked_for(const std::vector<StereoInput>& results, const std::string& asked);
/// The first plane that all files have, results before inputs.
std::string plane_to_compare(const std::vector<StereoInput>& results);

}  // namespace gloam::cli
