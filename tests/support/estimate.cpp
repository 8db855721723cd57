#include "support/estimate.h"

#include <algorithm>
#include <cmath>

namespace gloam::test {

Settings joined(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

Plan plan_of(const std::string& technique, const Frame& frame, const Settings& settings,
             const std::vector<std::string>& only, int resolution) {
  return make_plan(
      {.outputs = {technique}, .only_outputs = only, .filter = "none", .settings = settings, .resolution = resolution},
      plane_names(frame), "this frame");
}

Frame raw_of(const std::string& technique, const Frame& frame, const Settings& settings, const RunOptions& options,
             int resolution) {
  return run(plan_of(technique, frame, settings, {"ao_raw"}, resolution), frame, device(), options).frame;
}

Frame open_directions_of(const std::string& technique, const Frame& frame, const Settings& settings) {
  return run(plan_of(technique, frame, settings, {"bent_normal", "cone"}), frame, device()).frame;
}

float value_at(const Frame& frame, const std::string& plane, int x, int y) {
  return frame.views[0].find(plane)->channels[0].at(x, y);
}

glm::dvec3 vector_at(const Frame& frame, const std::string& plane, int x, int y) {
  const std::vector<Channel>& c = frame.views[0].find(plane)->channels;
  return {c[0].at(x, y), c[1].at(x, y), c[2].at(x, y)};
}

float raw_at(const Frame& result, int x, int y) { return value_at(result, "ao_raw", x, y); }

double largest_occlusion(const Frame& result) {
  double largest = 0;
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) largest = std::max(largest, std::abs(1.0 - raw_at(result, x, y)));
  }
  return largest;
}

}  // namespace gloam::test
