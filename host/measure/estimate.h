// HBAO+ as the baselines compute it: fixed parameters, and their common arguments.
#pragma once

#include "gloam/frame.h"
#include "hbao_plus/params.h"

namespace gloam::bench {

inline constexpr int directions = 8, steps = 4;

/// Camera and layout of a frame in float, as kernels get them; laid out like `Camera` in naive.cl.
struct PixelCamera {
  int width, height, pitch, seed;
  float scale_x, scale_y;    ///< scene units per pixel at depth 1
  float centre_x, centre_y;  ///< principal point, pixels from the planes' first
};

inline PixelCamera pixel_camera(const Frame& frame) {
  const Camera& camera = *frame.views[0].camera;
  const Layout layout(frame.width(), frame.height());
  return {layout.width,
          layout.height,
          layout.pitch,
          0,
          float(1 / camera.fx),
          float(1 / camera.fy),
          float(camera.cx - frame.window.x0),
          float(camera.cy - frame.window.y0)};
}

}  // namespace gloam::bench
