// The cameras of a file's views: by flag, by header or by a JSON.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "camera/depth_relation.h"
#include "exr/file.h"
#include "exr/json_cameras.h"

namespace gloam {

/// What the positions of a view tell.
struct PositionFindings {
  std::optional<Camera> camera;          ///< that leads to the positions; with a pose
  bool is_fitted = false;                ///< the camera, or its pose, is not from elsewhere
  bool agrees = true;                    ///< a camera from elsewhere leads to the positions
  bool in_camera_space = false;          ///< the positions, which then tell no pose in the world
  double median = 0, percentile_99 = 0;  ///< distance in the image of the positions from their pixels
  DepthRelation depth;                   ///< to the file's depth
  std::optional<glm::vec3> background;   ///< the position that background has, as stored, besides zero and infinity
};

struct FileCameras {
  std::map<std::string, Camera> cameras;              ///< by view; without views whose camera is unknown
  std::map<std::string, Pose> poses;                  ///< of views whose header has a pose but no whole camera
  std::map<std::string, PositionFindings> positions;  ///< by view; filled by `settle_by_positions`
  std::map<std::string, std::string> why_not_fitted;  ///< by view: why no camera could be fitted to its positions
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
