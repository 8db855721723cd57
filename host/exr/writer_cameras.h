// Cameras that renderers describe in attributes of their own, beside OpenEXR's standard ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exr/headers.h"
#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// The camera by the attributes of V-Ray, Unreal's Movie Render Queue or Redshift in a header; without a pose where the writer's
/// convention for it is not established. None if there are no such attributes. Appends a note that names the writer, and one for
/// attributes that are not used. `pixel_aspect`: width of a pixel over its height. Throws Error for values that describe no camera.
std::optional<Camera> writer_camera(const Imf::Header& header, const Window& display, double pixel_aspect,
                                    std::vector<std::string>& notes);

}  // namespace gloam
