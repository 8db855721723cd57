#include "gloam/scene/sky_map.h"

#include "gloam/environment_map.h"
#include "gloam/scene/radiance.h"

namespace gloam {

Frame sky_map(const Scene& scene, int height) {
  const int width = 2 * height;
  const EnvironmentMap directions(width, height, std::vector<glm::vec3>(size_t(width) * size_t(height)));
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  frame.views.emplace_back();
  Plane& color = frame.views[0].planes["color"];
  color.name = "color";
  for (int i = 0; i < 3; ++i) color.channels.emplace_back(Layout(width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec3 radiance = sky_radiance(scene, directions.direction({x + 0.5, y + 0.5}));
      for (int i = 0; i < 3; ++i) color.channels[size_t(i)].at(x, y) = radiance[i];
    }
  }
  frame.attributes = {{"envmap", "latlong"}, {"gloamScene", scene.name}};
  return frame;
}

}  // namespace gloam
