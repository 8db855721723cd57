// A camera from the fields of one view of a camera JSON.
#pragma once

#include <string>
#include <vector>

#include "camera/camera_fields.h"
#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// The camera in pixels of `display`. A JSON for another size of the same aspect is scaled, with a note to `assumed`. Throws
/// Error as `read_camera_file` does (camera_json.h).
Camera camera_of_view(const CameraFields& fields, const Window& display, std::vector<std::string>& assumed);

}  // namespace gloam
