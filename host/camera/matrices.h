// Cameras from EXR header matrices, and back to matrices.
#pragma once

#include <Imath/ImathMatrix.h>

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// The camera of OpenEXR's standard attributes: `world_to_camera` left-handed looking along +z, `world_to_ndc` to [0,1] over the
/// display window, y down, both for row vectors (Imath); `origin` (gloamOrigin): the point that they are relative to. Two other
/// forms are recognised by the matrices and read as well, with a note to `assumed`: `world_to_ndc` with y up, to [-1,1] as Arnold
/// writes it or to [0,1], whichever has the principal point nearer to the middle of the image; and `world_to_camera` that looks
/// along -z.
///
/// A right-handed world makes `world_to_camera` a mirror (determinant -1) and the pose a rotation. A left-handed world
/// (determinant +1) is kept as it is: the pose then mirrors, and world-space positions and normals still come out right
/// in gloam's right-handed view space. Near and far are not read: OpenEXR gives z no meaning in NDC.
///
/// Throws Error naming the matrix if it is singular, not finite, scaled or sheared, or if it mirrors, turns or tilts the
/// image, or is an oblique projection.
Camera camera_from_matrices(const Imath::M44d& world_to_camera, const Imath::M44d& world_to_ndc, const Window& display,
                            const glm::dvec3& origin, std::vector<std::string>* assumed = nullptr);

/// The pose alone, for a header without `world_to_ndc`. Throws Error as `camera_from_matrices` does.
Pose pose_from_matrix(const Imath::M44d& world_to_camera, const glm::dvec3& origin);

/// The inverse: matrices relative to the camera's own position, which goes into `origin`. A camera without a pose is written as
/// one at the origin that looks along -z, y up.
struct CameraMatrices {
  Imath::M44d world_to_camera, world_to_ndc;
  glm::dvec3 origin;
};
CameraMatrices matrices_of(const Camera& camera, const Window& display);

}  // namespace gloam
