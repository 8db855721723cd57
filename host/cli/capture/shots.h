// The frames of a capture and their cameras: one frame, one for each moment of a path, or those of a light-field display.
#pragma once

#include <vector>

#include "cli/capture/command.h"

namespace gloam::cli {

/// The cameras of the frames of --camera-path or --shot.
struct CameraPath {
  std::string flag;  ///< "--shot walk", for messages
  std::vector<Camera> cameras;
  const ShotRecipe* recipe = nullptr;  ///< of a built-in shot
};

/// `width` and `height`: of the image that the cameras are for. None for one frame. Throws UsageError for a shot that the scene lacks (with the nearest name), Error as `read_camera_path` does.
std::optional<CameraPath> path_of(const CaptureCommand& flags, int width, int height);

/// Of each frame one file with all modules, or one for each. The size is the display's if the flags give none. `path`: null for one
/// frame. Throws UsageError for a frame that the path lacks.
std::vector<CaptureShot> shots_of_display(const CaptureCommand& flags, const Tracer& tracer, CaptureOptions& options,
                                          const CameraPath* path);
/// The frame of the scene's camera.
CaptureShot single_shot(const CaptureCommand& flags, const Scene& scene, int width, int height);
/// One file for each frame of a path, or for those that --frames names. Throws UsageError for a frame that the path lacks.
std::vector<CaptureShot> shots_of_path(const CaptureCommand& flags, const CameraPath& path);

/// "0,5,10-19": the first and the last of each item, whatever modules there are. Throws UsageError.
std::vector<std::pair<int, int>> parse_modules(const std::string& text, const std::string& flag);

}  // namespace gloam::cli
