#include "papers/eyes.h"

namespace gloam::bench {

StereoInconsistency inconsistency(const Stage& s, const Image& ao, const StereoOptions& options) {
  return inconsistency(s.frame, {0, 1}, ao, options);
}

StereoInconsistency inconsistency(const Frame& frame, const std::array<size_t, 2>& views, const Image& ao,
                                  const StereoOptions& options) {
  Frame pair;
  pair.display = frame.display;
  pair.window = frame.window;
  for (const size_t i : views) {
    const View& view = frame.views.at(i);
    View& copy = pair.views.emplace_back();
    copy.name = view.name;
    copy.camera = view.camera;
    for (const char* plane : {"depth", "normal"}) copy.planes[plane] = view.planes.at(plane).clone();
    copy.planes["ao"] = ao.at(view.name).clone();
  }
  return stereo_inconsistency(pair, "ao", options);
}

double in_hundred_thousandths(const StereoFigures& figures) { return 1e5 * figures.mean; }

}  // namespace gloam::bench
