// What the values of depth and normals stand for where a file or an array holds them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// `inverse`: 1 / z, up to a factor, as disparities are.
enum class DepthConvention { automatic, z, ray, ndc, reversed, inverse };

/// Normalised device depth: a share of the depth range, not a length.
inline bool is_window_depth(DepthConvention depth) {
  return depth == DepthConvention::ndc || depth == DepthConvention::reversed;
}

/// In which order three bytes of 8 bits hold depth of 24: red the lowest, or red the highest.
enum class DepthBytes { automatic, low_first, high_first };

/// What was done to a depth before it was stored. `srgb`: the sRGB curve is in it, as in a picture; `bottom_up`: its rows run from the bottom
/// up, other than those of the other planes; `wrapped`: whole numbers of 16 bits that begin again at 0 past 65535.
struct DepthEncoding {
  bool srgb = false, bottom_up = false, wrapped = false;
  bool operator==(const DepthEncoding&) const = default;
};

/// What is stated of depth.
struct StatedDepth {
  DepthConvention convention = DepthConvention::automatic;
  std::optional<double> near, far;  ///< for NDC and reversed depth, and the far plane as background
  std::optional<float> background;  ///< depth that means background, instead of 1e10 and more
  std::optional<double> scale,
      offset;               ///< what is stored, times the scale, plus the offset, is what the convention says
  bool is_of_shot = false;  ///< frames of a shot are read alike: what one of them shows is told, and not taken
  std::optional<DepthEncoding> encoding;  ///< undone before anything else; none: what is found
};
inline bool states_anything(const StatedDepth& depth) {
  return depth.convention != DepthConvention::automatic || depth.near || depth.far || depth.background || depth.scale ||
         depth.offset || depth.encoding;
}

enum class NormalSpace { automatic, view, world };

/// `signed_values`: components from -1 to 1. `unsigned_values`: 0.5 + 0.5 n, from 0 to 1. `srgb_values`: that with the sRGB curve, as a picture.
enum class NormalRange { automatic, signed_values, unsigned_values, srgb_values };

/// For each component in storage the axis that it lies along, 1 to 3 for x, y and z, negative where it points the other way: {1, -2, 3} are
/// normals with y down. The axes are those of the camera (x right, y up, z towards the eye), or those of its world.
using NormalAxes = std::array<int, 3>;
inline constexpr NormalAxes plain_axes = {1, 2, 3};

/// What is stated of normals. What is not stated is found: the convention that agrees best with the depth.
struct NormalConvention {
  NormalSpace space = NormalSpace::automatic;
  NormalRange range = NormalRange::automatic;
  std::optional<NormalAxes> axes;
};

/// How a depth of which nothing is stated was read. Of one frame of a shot it holds for all of them.
struct FoundDepth {
  std::optional<StatedDepth> read;  ///< none where something states it, or there is no depth
  bool is_told = false;             ///< normals or plane surfaces tell it; else it is planar distance for want of a reason
  std::vector<std::string> notes;   ///< what was assumed, a sentence each
};

/// A convention that normals showed. Of one frame of a shot it holds for all of them.
struct FoundNormals {
  NormalConvention convention;     ///< whole; empty where no pixel has both a depth and a normal
  std::vector<std::string> notes;  ///< what was assumed, a sentence each
};

}  // namespace gloam
