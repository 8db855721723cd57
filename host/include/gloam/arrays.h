// Frames from arrays in memory, and arrays from frames.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// What a renderer has in memory of one view. The arrays are read while `frame_from` runs, and no longer.
struct Arrays {
  int width = 0, height = 0;  ///< pixels, 1 to 65536 each way, 2^28 in all
  Camera camera = {};         ///< of an image whose top left corner is (0, 0); `camera_with_fov` makes a plain one
  /// By the names of planes.h: "depth", "normal", "color" ... Rows from the top, without padding, the components of a pixel
  /// side by side: width * height * components values.
  ///
  /// depth: distance along the viewing axis, scene units. What is no surface is +inf, NaN, not above 0, 1e10 or more, or the
  ///   camera's far plane.
  /// normal: x to the right, y up, z towards the eye (view space), of any length; (0, 0, 0) where it is not known.
  /// Without normals, techniques that read them make them from depth.
  std::map<std::string, std::span<const float>> planes = {};
};

/// A camera of square pixels that looks through the middle of the image; `degrees`: its horizontal field of view, 1 to 179.
/// Throws Error for a size or an angle that is not allowed.
Camera camera_with_fov(int width, int height, double degrees);

/// A frame of one view, whose name is empty, that has passed `normalise` (normalise.h): ready for a plan. Values are copied.
/// Throws Error for a size that is not allowed, an array of another size than the image's, a null pointer, a camera that is not finite
/// or has no focal length, and where memory runs out.
Frame frame_from(const Arrays& arrays);

/// The values of a plane of a view, in the order of `Arrays::planes`. Throws Error where the frame has no such view or plane.
std::vector<float> values_of(const Frame& frame, const std::string& plane, const std::string& view = "");

}  // namespace gloam
