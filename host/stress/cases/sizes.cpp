// Hard case 11: images of every shape. What lies beside an image in memory must not reach it.
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

/// Everything beside the image becomes a value that would show.
void spoil_padding(Frame& frame, float value) {
  for (View& view : frame.views) {
    for (auto& [name, plane] : view.planes) {
      for (Channel& channel : plane.channels) channel.fill_padding(value);
    }
  }
}

struct Size {
  int width, height;
};

std::vector<Size> sizes(bool is_quick) {
  if (is_quick) return {{1, 1}, {1, 33}, {33, 1}, {17, 13}, {16384, 1}};
  return {{1, 1}, {1, 33}, {33, 1}, {2, 2}, {15, 3}, {16, 3}, {17, 13}, {16384, 1}, {1, 16384}, {32769, 3}};
}

void sizes_and_padding(Probe& probe) {
  const Settings few = few_samples(probe.technique());
  for (const auto& [width, height] : sizes(probe.is_quick())) {
    const double fov = width > 1000 ? 150 : 60;
    for (const Shot& shot : {perspective(width, height, fov), orthographic(width, height, width * 0.05)}) {
      Frame frame = shoot(shot, room());
      plan_for(probe.technique(), frame);  // the second view's padding is spoilt too
      Lazy<Frame> expected([&] { return probe.outputs(frame, few, {.math = Math::precise, .lanes = 1}); });
      for (const int lanes : usual_lanes(probe.device())) {
        for (const float beside : {0.37f, 5.0f}) {
          const RunOptions way{.math = Math::precise, .lanes = lanes};
          if (!probe.tries(fmt::format("{}x{}, {} beside the image, {}, {}", width, height, beside,
                                       text_of(shot.camera), text_of(way))))
            continue;
          Frame spoilt = clone(frame);
          spoil_padding(spoilt, beside);
          const Frame out = probe.outputs(spoilt, few, way);
          probe.measure_violation("value out of its range", out);
          probe.measure("size: columns and rows too few or too many",
                        double(std::abs(out.width() - width) + std::abs(out.height() - height)), 0);
          probe.measure_bits("difference by what lies beside the image, or by lanes", out, expected.get());
        }
      }
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> sizes() {
  return {{11,
           "images of every shape",
           "Images of 1x1, one row, one column, odd sizes and 16384 pixels in a row have the right size, and the same "
           "bits whatever lies beside them in memory and however many lanes compute them.",
           {sizes_and_padding}}};
}

}  // namespace case_files
}  // namespace gloam::stress
