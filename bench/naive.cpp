#include "naive.h"

#include <fmt/format.h>

namespace gloam::bench {
namespace {

/// The layout of `Settings` in naive.cl.
struct Settings {
  float radius, bias, strength;
  float max_pixels;
  int directions, steps;
};

std::string options(Counts counts) {
  std::string text = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros";
  if (counts == Counts::unrolled) text += fmt::format(" -D DIRECTIONS={} -D STEPS={}", directions, steps);
  return text;
}

}  // namespace

Naive::Naive(Device& device, const Frame& frame, DevicePlanes& planes, const HbaoPlusParams& params, Counts counts)
    : device_(device), kernel_(build(device, naive_cl, options(counts), "naive_hbao_plus")) {
  const PixelCamera camera = pixel_camera(frame);
  kernel_.setArg(0, camera);
  kernel_.setArg(1, Settings{params.radius, params.bias, params.strength, params.max_reach * float(frame.width()),
                             directions, steps});
  kernel_.setArg(2, planes.depth);
  kernel_.setArg(3, planes.normal_x);
  kernel_.setArg(4, planes.normal_y);
  kernel_.setArg(5, planes.normal_z);
  kernel_.setArg(6, planes.result);
  global_ = cl::NDRange(size_t(camera.width), size_t(camera.height));
}

double Naive::run() { return launch(device_, kernel_, global_); }

}  // namespace gloam::bench
