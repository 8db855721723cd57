#include "eyes.h"

namespace gloam::bench {

StereoInconsistency inconsistency(const Stage& s, const Image& ao, const StereoOptions& options) {
  Frame pair;
  pair.display = s.frame.display;
  pair.window = s.frame.window;
  for (const View& view : s.frame.views) {
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
