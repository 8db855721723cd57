// A camera from the 4 x 4 projection matrix of a renderer.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gloam/camera.h"

namespace gloam {

/// Whose clip space a matrix maps to, for column vectors in all three.
///   opengl: y up, z from -1 to 1 over w; the camera looks along -z. A reversed z may go from 1 to 0 (glClipControl).
///   vulkan: y down, z from 0 to 1, reversed or not. The camera looks along -z with y up, or along +z with y down or up.
///   unreal: y up, z from 0 to 1, usually reversed and with the far plane infinitely far; the camera looks along +z. Unreal's own matrices
///     are for row vectors: transpose them.
enum class ClipSpace { opengl, vulkan, unreal };

/// A camera, without a pose, and the view space that its matrix is for.
struct ProjectedCamera {
  Camera camera;  ///< near and far are those of the matrix; far may be infinite
  /// What gloam's view space (right-handed, y up, looking along -z) multiplies y and z of the matrix's view space by: 1 or -1. x is the same.
  glm::dvec3 axes{1, 1, 1};
};

/// Perspective or orthographic, off-axis too. `width`, `height`: of the image, pixels. Throws UsageError for a matrix that is none of these: with
/// row 3 other than 0 0 -1 0, 0 0 1 0 or 0 0 0 1, as one for row vectors has it, which is said; that mirrors, shears or contains a view;
/// that has an oblique near plane; or whose near and far plane lie behind the camera or in the wrong order.
ProjectedCamera camera_from_projection(const glm::dmat4& projection, ClipSpace clip, int width, int height);

}  // namespace gloam
