// Cameras and poses that the headers of an EXR file describe.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exr/headers.h"
#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

class HeaderCameras {
 public:
  /// Cameras are in pixels of `display`. The headers must outlive this.
  HeaderCameras(const Headers& headers, const Window& display) : headers_(headers), display_(display) {}

  /// From `worldToCamera` and `worldToNDC`, or a module of the light-field display in `gloamDisplay`; none if the headers have no
  /// whole camera. Unusable attributes become a sentence in `notes`. Throws Error for matrices and displays that describe no
  /// camera.
  std::optional<Camera> camera(const std::string& view, std::vector<std::string>& notes);

  /// From `worldToCamera` alone, for headers without a whole camera.
  std::optional<Pose> pose(const std::string& view, std::vector<std::string>& notes) const;

 private:
  const std::map<std::string, Camera>& modules();

  const Headers& headers_;
  Window display_;
  std::map<std::string, Camera> modules_;  ///< of the light-field display, by view; empty until looked up
};

}  // namespace gloam
