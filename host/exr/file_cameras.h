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
  std::map<std::string, Camera> cameras;  ///< by view; none where nothing tells a view's camera
  std::map<std::string, Pose> poses;      ///< of views whose header tells the pose and nothing else
  std::string json_misfit;  ///< why the JSON beside the file is not used: it has no camera for some view; else empty
  std::vector<std::string> notes;  ///< what was assumed or not used, a sentence each

  bool has_pose(const std::string& view) const;
};

/// Throws UsageError for --near that is not less than --far.
void check_clipping_flags(const ReadOptions& options);

/// A header overrules a JSON that was found; --camera overrules the header, and --fov both, except for the pose. `eye`: where the
/// file is one of two. Throws Error for cameras that cannot be used, unless a flag takes their place or the caller only looks.
FileCameras find_cameras(const ExrFile& file, const std::optional<EyeOfPair>& eye);

}  // namespace gloam
