// The planes of a view that a capture fills.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

#include "gloam/camera.h"
#include "gloam/scene/capture.h"

namespace gloam {

/// The planes of one view, found once instead of by name for every pixel.
struct CaptureTarget {
  Channel* depth = nullptr;
  Channel *normal[3] = {}, *albedo[3] = {}, *color[3] = {}, *ambient[3] = {}, *emission[3] = {}, *reflectance[3] = {},
          *position[3] = {}, *motion[2] = {};
  Channel *roughness = nullptr, *metallic = nullptr, *back_depth = nullptr, *instance = nullptr, *peel_count = nullptr,
          *outline_count = nullptr;
  bool has_material = false;  ///< any plane of what a surface is made of, or of its light
  std::vector<Channel*> peel, stochastic;
  std::vector<std::array<Channel*, 3>> peel_color, peel_normal;
};

/// Adds the planes that are asked for to the view, filled with the value of pixels without a surface.
CaptureTarget capture_target(View& view, const CaptureOptions& options, const Layout& layout);

/// Stores a vector; does nothing if the channels are not captured.
template <typename Channels, typename Vector>
void put(const Channels& channels, int x, int y, const Vector& value) {
  if (!channels[0]) return;
  for (size_t i = 0; i < std::size(channels); ++i) channels[i]->at(x, y) = float(value[int(i)]);
}

/// The depth at which a view's frustum ends; infinite if the camera has no far plane.
double far_of(const Camera& camera);

/// Whether the image shows anything at a pixel: light of a display's module may miss the screen there.
bool shows(const Camera& camera, int x, int y);

}  // namespace gloam
