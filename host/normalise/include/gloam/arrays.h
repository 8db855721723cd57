// Frames from arrays in memory, and arrays from frames.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "gloam/conventions.h"
#include "gloam/frame.h"

namespace gloam {

/// One view in a renderer's memory. The arrays are read only while `frame_from` runs.
struct Arrays {
  int width = 0, height = 0;  ///< pixels, 1 to 65536 each way, 2^28 in all
  Camera camera = {};         ///< in pixels of an image whose top left corner is (0, 0); see `camera_with_fov`
  /// Planes by the names of planes.h: "depth", "normal", "color" ... Rows from the top, without padding, the components of a
  /// pixel side by side: width * height * components values.
  ///
  /// depth: distance along the viewing axis, scene units. Background is +inf, NaN, 0 or less, 1e10 or more, or the camera's
  ///   far plane. The sign of depths that are all negative is changed, with a note.
  /// normal: view space (x to the right, y up, z towards the eye), of any length; (0, 0, 0) where unknown. Techniques that
  ///   need normals make them from depth where a frame has none. Normals that agree with the depth in another convention alone
  ///   are taken in that one, with a note in `Frame::assumed`, where `normals` does not state theirs.
  std::map<std::string, std::span<const float>> planes = {};
  NormalConvention normals = {};  ///< of the plane "normal", where it is known
  /// Of the plane "depth", if it is no distance along the viewing axis, or its background or clipping planes are known: as for files
  /// (ReadOptions), with the camera's near and far where these are not stated.
  StatedDepth depth = {};
};

/// A camera with square pixels and its principal point in the middle of the image; `degrees`: horizontal field of view, 1 to 179.
/// Throws Error for a size or an angle out of range.
Camera camera_with_fov(int width, int height, double degrees);

/// A frame of one view, named "", that has passed `normalise` (normalise.h): ready for a plan. Values are copied. Throws Error for
/// a size out of range, an array whose size is not the image's, a null pointer, a camera that is not finite or has no focal length,
/// and where memory runs out.
Frame frame_from(const Arrays& arrays);

/// A plane of values as they are, in the order of `Arrays::planes`: for comparing and writing. Throws Error as `frame_from` does for an
/// array.
Plane plane_from(const std::string& name, int width, int height, std::span<const float> values);

/// The values of a plane of a view, in the order of `Arrays::planes`. Throws Error if the frame has no such view or plane.
std::vector<float> values_of(const Frame& frame, const std::string& plane, const std::string& view = "");

}  // namespace gloam
