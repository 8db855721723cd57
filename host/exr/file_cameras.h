// The cameras of a file's views: by flag, by header or by a JSON.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exr/file.h"
#include "exr/json_cameras.h"

namespace gloam {

struct FileCameras {
  std::map<std::string, Camera> cameras;  ///< by view; without views whose camera is unknown
  std::map<std::string, Pose> poses;      ///< of views whose header has a pose but no whole camera
  std::string json_misfit;  ///< why the JSON beside the file is not used: it has no camera for some view; else empty
  std::vector<std::string> notes;  ///< on assumptions and unused cameras, a sentence each

  bool has_pose(const std::string& view) const;
};

/// Throws UsageError if --near is not less than --far.
void check_clipping_flags(const ReadOptions& options);

/// The header overrides a JSON beside the file; --camera overrides the header, and --fov overrides both, except for the pose.
/// `eye`: set if the file is one of two. Throws Error for cameras that cannot be used, unless a flag replaces them or `only_looks`
/// is set.
FileCameras find_cameras(const ExrFile& file, const std::optional<EyeOfPair>& eye);

}  // namespace gloam
