// Cameras from a JSON beside the frame and from EXR header matrices, and back to matrices.
#pragma once

#include <Imath/ImathMatrix.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// The camera JSON that belongs to a frame (docs/gbuffer.md): the file whose stem (before `.camera`) is the longest
/// prefix of the frame's name, else `camera*.json` in the folder. A JSON that is named neither `*.camera.json` nor
/// `camera*.json` counts only when it holds a camera; where it cannot be read or has "views" that are none, and no
/// other file fits the frame's name, a sentence goes to `notes`. None when there is none; throws Error naming both when
/// two fit equally.
std::optional<std::filesystem::path> find_camera_file(const std::filesystem::path& frame,
                                                      std::vector<std::string>* notes = nullptr);

/// Cameras by view name, in pixels of `display` (scaled when the JSON was made for another size of the same aspect; a
/// note goes to `assumed`). A JSON of one view is returned under "", whatever the view's name; so is a view "mono".
/// Fields are looked up in the view, then at the top. camera_to_world wins over world_to_camera, fields in pixels over
/// projection_gl. Rotations may be off by float rounding (1e-4) and are made orthonormal.
/// Throws Error naming the file, the field that is missing, of the wrong type, not finite (NaN and Infinity as Python
/// writes them included), not rigid or out of range (a focal length over 1e7 pixels, a centre beyond 1e6), and what is
/// expected there.
std::map<std::string, Camera> read_camera_file(const std::filesystem::path& file, const Window& display,
                                               std::vector<std::string>& assumed);

/// The cameras of a path: the list "path" of a camera JSON, one view per camera, fields looked up in the entry, then at
/// the top. "frames" (2 to 100000) asks for that many cameras instead, evenly along the list: places and intrinsics in
/// straight lines, rotations by the shortest turn. Throws Error as `read_camera_file` does.
std::vector<Camera> read_camera_path(const std::filesystem::path& file, const Window& display,
                                     std::vector<std::string>& assumed);

/// The camera that OpenEXR's standard attributes describe: `world_to_camera` left-handed looking along +z,
/// `world_to_ndc` to [0,1] over the display window, y down, both for row vectors (Imath); `origin` (gloamOrigin) is
/// what they are relative to. Two other forms are told by the matrices themselves and read as well, with a sentence to `assumed`:
/// `world_to_ndc` with y up, to [-1,1] as Arnold writes it or to [0,1], whichever has the principal point nearer to the middle
/// of the image; and `world_to_camera` that looks along -z.
///
/// A right-handed world makes `world_to_camera` a mirror (determinant -1) and the pose a rotation. A left-handed world
/// (determinant +1) is kept as it is: the pose then mirrors, and world-space positions and normals still come out right
/// in gloam's right-handed view space. Near and far are not read: OpenEXR gives z no meaning in NDC.
///
/// Throws Error naming the matrix that is singular, not finite, scaled or sheared, or that mirrors, turns or tilts the
/// image, or is an oblique projection.
Camera camera_from_matrices(const Imath::M44d& world_to_camera, const Imath::M44d& world_to_ndc, const Window& display,
                            const glm::dvec3& origin, std::vector<std::string>* assumed = nullptr);

/// The pose alone, for a header without `world_to_ndc`. Throws Error as `camera_from_matrices` does.
Pose pose_from_matrix(const Imath::M44d& world_to_camera, const glm::dvec3& origin);

/// The inverse: matrices relative to the camera's own position, which goes into `origin`. A camera without a pose is
/// written as one at the origin that looks along -z, y up.
struct CameraMatrices {
  Imath::M44d world_to_camera, world_to_ndc;
  glm::dvec3 origin;
};
CameraMatrices matrices_of(const Camera& camera, const Window& display);

/// A camera with the given horizontal field of view over the display window, centred, without a pose. `pixel_aspect`: width of
/// a pixel over its height. Throws UsageError unless 1 to 179 degrees.
Camera camera_from_fov(double degrees, const Window& display, double pixel_aspect, const std::string& source);

}  // namespace gloam
