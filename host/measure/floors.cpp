#include "measure/floors.h"

#include <fmt/format.h>

#include "base/cpu_time.h"
#include "run/tuning.h"
#include "technique/kernel_sources.h"

namespace gloam::bench {
namespace {

#define FRAME_SCALAR float
#define FRAME_NAME KernelFrame
#include "shared/both/frame.h"
#undef FRAME_SCALAR
#undef FRAME_NAME

KernelFrame kernel_frame(const Frame& frame) {
  const PixelCamera c = pixel_camera(frame);
  return {c.width,
          c.height,
          c.pitch,
          c.seed,
          c.scale_x,
          c.scale_y,
          c.centre_x,
          c.centre_y,
          frame.views[0].camera->orthographic ? 0.0f : 1.0f,
          frame.views[0].camera->orthographic ? 1.0f : 0.0f};
}

std::string options(const Tuning& tuning) {
  return fmt::format("-cl-std=CL1.2 -D MATH_FAST=1 {} -D DIRECTIONS={} -D STEPS={} -D JITTER=1", options_of(tuning),
                     directions, steps);
}

KernelText gather_text(const Tuning& tuning) {
  return {flatten("shared/sampling/fan.h") + gather_floor_cl, options(tuning), "gather_floor"};
}

KernelText copy_text(const Tuning& tuning) {
  return {flatten("shared/lanes/load.h") + copy_floor_cl, options(tuning), "copy_floor"};
}

constexpr int fma_steps = 16;
constexpr int fma_sums = 12;  // as fma_peak.cl has them

KernelText fma_text(const Tuning& tuning) {
  return {flatten("shared/lanes/load.h") + fma_peak_cl, options(tuning) + fmt::format(" -D FMA_STEPS={}", fma_steps),
          "fma_peak"};
}

}  // namespace

std::vector<KernelText> floor_texts(const Tuning& tuning) {
  return {gather_text(tuning), copy_text(tuning), fma_text(tuning)};
}

Floor::Floor(Device& device, const Frame& frame, const KernelText& text)
    : kernel_(build(device, text.text, text.options, text.kernel)), device_(device) {
  const KernelFrame argument = kernel_frame(frame);
  kernel_.setArg(0, argument);
  global_ = cl::NDRange(size_t(argument.pitch / device.info().tuning.lanes), size_t(argument.height));
}

double Floor::run() {
  const double before = process_cpu_ms();
  const double ms = launch(device_, kernel_, global_);
  if (device_.info().type == "cpu") cpu_ms_ = process_cpu_ms() - before;
  return ms;
}

GatherFloor::GatherFloor(Device& device, const Frame& frame, DevicePlanes& planes, const HbaoPlusParams& params)
    : Floor(device, frame, gather_text(device.info().tuning)) {
  kernel_.setArg(1, params.radius);
  kernel_.setArg(2, params.max_reach);
  kernel_.setArg(3, planes.depth);
  kernel_.setArg(4, planes.result().buffer);
}

FmaPeak::FmaPeak(Device& device, const Frame& frame, DevicePlanes& planes)
    : Floor(device, frame, fma_text(device.info().tuning)) {
  kernel_.setArg(1, 0.5f);
  kernel_.setArg(2, 0.25f);
  kernel_.setArg(3, planes.result().buffer);
  const PixelCamera c = pixel_camera(frame);
  operations_ = 2.0 * fma_steps * fma_sums * c.pitch * c.height;
}

CopyFloor::CopyFloor(Device& device, const Frame& frame, DevicePlanes& planes)
    : Floor(device, frame, copy_text(device.info().tuning)) {
  kernel_.setArg(1, planes.depth);
  kernel_.setArg(2, planes.result().buffer);
}

}  // namespace gloam::bench
