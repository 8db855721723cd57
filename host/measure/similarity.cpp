#include "measure/similarity.h"

#include "compare/grey_flip.h"
#include "compare/plane_pairs.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/stereo_consistency.h"

namespace gloam::bench {

Metrics metrics_of(const Plane& test, const Plane& truth, const Mask& foreground, double exposure) {
  Metrics metrics = compare(test, truth, foreground, exposure);
  const bool is_grey = test.channels.size() == 1 && plane_kind(test.name).meaning == PlaneKind::unit_interval;
  if (is_grey) metrics.flip = grey_flip(test, truth, foreground);
  return metrics;
}

std::map<std::string, Metrics> metrics_of_views(const Image& test, const Image& truth, const Foreground& foreground,
                                                double exposure) {
  std::map<std::string, Metrics> views;
  for (const auto& [view, mask] : foreground) {
    const auto tested = test.find(view), expected = truth.find(view);
    if (tested != test.end() && expected != truth.end())
      views.emplace(view, metrics_of(tested->second, expected->second, mask, exposure));
  }
  return views;
}

Similarity similarity(const Image& test, const Image& truth, const Foreground& foreground) try {
  std::vector<Metrics> views;
  for (const auto& [view, metrics] : metrics_of_views(test, truth, foreground)) views.push_back(metrics);
  if (views.empty()) return {};
  const Metrics all = pooled(views);
  return {all.ssim, all.flip};
} catch (const Error&) {
  return {};
}

std::optional<double> inconsistency(const Frame& frame, const Image& image) try {
  if (frame.views.size() != 2 || image.size() != 2) return {};
  Frame pair = without_planes(frame);
  for (View& view : pair.views) {
    const View& from = frame.view(view.name);
    for (const char* plane : {"depth", "normal"}) {
      if (const Plane* given = from.find(plane)) view.planes.emplace(plane, given->clone());
    }
    const Plane& made = image.at(view.name);
    view.planes.emplace(made.name, made.clone());
  }
  return stereo_inconsistency(pair, image.begin()->second.name).both.mean;
} catch (const Error&) {  // no poses, or no surface in common
  return {};
}

}  // namespace gloam::bench
