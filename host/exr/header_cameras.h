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
  /// `pixel_aspect`: width of a pixel over its height.
  HeaderCameras(const Headers& headers, const Window& display, double pixel_aspect = 1)
      : headers_(headers), display_(display), pixel_aspect_(pixel_aspect) {}

  /// From `worldToCamera` and `worldToNDC`, a module of the light-field display in `gloamDisplay`, or a renderer's own attributes
  /// (writer_cameras.h); none if the headers have no whole camera. Unusable attributes become a sentence in `notes`. Throws Error for matrices and displays that describe no
  /// camera.
  std::optional<Camera> camera(const std::string& view, std::vector<std::string>& notes);

  /// The lens by a renderer's own attributes that tell no place; none if there is no such lens.
  std::optional<Camera> lens(const std::string& view, std::vector<std::string>& notes) const;

  /// From `worldToCamera` alone, for headers without a whole camera.
  std::optional<Pose> pose(const std::string& view, std::vector<std::string>& notes) const;

 private:
  const std::map<std::string, Camera>& modules();
  std::optional<Camera> of_writer(const std::string& view, std::vector<std::string>& notes) const;

  const Headers& headers_;
  Window display_;
  double pixel_aspect_;
  std::map<std::string, Camera> modules_;  ///< of the light-field display, by view; empty until looked up
};

}  // namespace gloam
