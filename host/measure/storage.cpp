#include "measure/storage.h"

#include <algorithm>
#include <cmath>

#include "gloam/planes.h"
#include "measure/measures.h"

namespace gloam::bench {
namespace {

/// Rounds values relative to `unit`.
void store_in_half(Plane& plane, float unit) {
  for (Channel& channel : plane.channels) {
    for (int y = 0; y < channel.layout().height; ++y) {
      float* row = channel.row(y);
      for (int x = 0; x < channel.layout().width; ++x) row[x] = as_half(row[x] / unit) * unit;
    }
  }
}

}  // namespace

float as_half(float value) {
  constexpr int digits = 11, least_exponent = -13;  // of std::frexp: 2^-14 is the smallest with all digits
  constexpr float largest = 65504;
  if (!std::isfinite(value)) return value;
  int exponent = 0;
  std::frexp(value, &exponent);
  const int place = std::max(exponent, least_exponent) - digits;
  return std::clamp(std::ldexp(std::nearbyint(std::ldexp(value, -place)), place), -largest, largest);
}

void store_in_half(Plane& plane) { store_in_half(plane, 1); }

Frame stored_in_half(const Frame& frame) {
  Frame out;
  out.display = frame.display;
  out.window = frame.window;
  for (const View& view : frame.views) {
    View& copy = out.views.emplace_back(
        View{.name = view.name, .camera = view.camera, .origin = view.origin, .light = view.light});
    const double depth = median_depth(view);
    for (const auto& [name, plane] : view.planes) {
      Plane& target = copy.planes.emplace(name, plane.clone()).first->second;
      const PlaneKind::Meaning meaning = plane_kind(name).meaning;
      if (meaning == PlaneKind::view_depth && depth > 0)
        store_in_half(target, float(depth));
      else if (meaning != PlaneKind::view_depth && meaning != PlaneKind::value)
        store_in_half(target);
    }
  }
  return out;
}

}  // namespace gloam::bench
