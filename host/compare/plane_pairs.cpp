#include "compare/plane_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lists.h"

namespace gloam {

const std::vector<PlanePair>& result_pairs() {
  static const std::vector<PlanePair> pairs = {{"ao", "ao"},
                                               {"ao_raw", "ao_raw"},
                                               {"ao_raw", "ao"},
                                               {"ao", "ao_raw"},
                                               {"reflection", "reflection"},
                                               {"bent_normal", "bent_normal"},
                                               {"cone", "cone"},
                                               {"hit", "hit"},
                                               {"indirect", "indirect"},
                                               {"indirect_raw", "indirect_raw"},
                                               {"indirect_raw", "indirect"},
                                               {"bounces", "bounces"},
                                               {"specular_occlusion", "specular_occlusion"},
                                               {"contact", "contact"},
                                               {"environment", "environment"}};
  return pairs;
}

std::vector<std::string> results_among(const std::vector<std::string>& planes) {
  std::vector<std::string> results;
  for (const PlanePair& pair : result_pairs()) {
    if (contains(planes, pair.test)) add_new(results, pair.test);
  }
  return results;
}

std::vector<std::string> inputs_among(const std::vector<std::string>& planes) {
  std::vector<std::string> inputs;
  for (const char* plane : {"color", "normal", "mask", "outline_count", "depth"}) {
    if (contains(planes, plane)) add_new(inputs, plane);
  }
  const std::vector<std::string> results = results_among(planes);
  for (const std::string& plane : planes) {
    if (!contains(results, plane)) add_new(inputs, plane);
  }
  return inputs;
}

Plane without_confidence(Plane plane) {
  if (plane.name == "reflection" && plane.channels.size() == 4) plane.channels.pop_back();
  return plane;
}

std::optional<Mask> shown_pixels(const Plane& truth, const Mask& mask) {
  if (truth.name != "reflection" || truth.channels.size() != 4) return {};
  Mask shown = mask;
  const Layout& layout = truth.channels[0].layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const size_t i = size_t(y) * size_t(layout.width) + size_t(x);
      shown[i] = shown[i] && truth.channels[3].at(x, y) > 0.5f;
    }
  }
  if (std::none_of(shown.begin(), shown.end(), [](auto m) { return m != 0; })) return {};
  return shown;
}

Metrics pooled(const std::vector<Metrics>& views) {
  if (views.size() == 1) return views.front();
  Metrics all;
  for (const Metrics& m : views) all.pixels += m.pixels;
  for (const Metrics& m : views) {
    const double share = double(m.pixels) / double(all.pixels);
    all.mae += share * m.mae;
    all.rmse += share * m.rmse * m.rmse;
    all.bias += share * m.bias;
    all.max = std::max(all.max, m.max);
    all.over_1_255 += share * m.over_1_255;
    all.over_0_05 += share * m.over_0_05;
    all.ssim += share * m.ssim;
    all.gmsd += share * m.gmsd;
    if (m.flip) all.flip = all.flip.value_or(0) + share * *m.flip;
    if (m.rse) all.rse = all.rse.value_or(0) + share * *m.rse;
  }
  all.rmse = std::sqrt(all.rmse);
  if (all.rmse > 0) all.psnr = -20 * std::log10(all.rmse);
  return all;
}

}  // namespace gloam
