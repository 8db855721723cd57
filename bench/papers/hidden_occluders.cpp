#include "papers/hidden_occluders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "gloam/planes.h"

namespace gloam::bench {
namespace {

constexpr int grid = 8, directions = 8, steps = 8;

struct Point {
  glm::dvec3 position, normal;
};

/// View space.
glm::dvec3 position_at(const Frame& frame, int x, int y, double depth) {
  const Camera& c = *frame.views[0].camera;
  const double scale = c.orthographic ? 1 : depth;
  return {(x + 0.5 + frame.window.x0 - c.cx) / c.fx * scale, (c.cy - y - 0.5 - frame.window.y0) / c.fy * scale, -depth};
}

bool occludes(const Point& point, const glm::dvec3& occluder, double radius) {
  const glm::dvec3 v = occluder - point.position;
  const double distance = glm::length(v);
  return distance < radius && glm::dot(v, point.normal) > 0.02 * distance;
}

/// The layer of the nearest occluder; 0 if the first layer occludes, or none does.
int layer_at(const Frame& frame, const std::vector<const Channel*>& layers, const Point& point, int x, int y,
             double radius) {
  for (size_t k = 0; k < layers.size(); ++k) {
    const double depth = layers[k]->at(x, y);
    if (!std::isinf(depth) && occludes(point, position_at(frame, x, y, depth), radius)) return int(k);
  }
  return 0;
}

}  // namespace

std::vector<long long> layers_of_hidden_occluders(const Frame& frame, double radius) {
  const View& view = frame.views[0];
  const Channel& depth = view.planes.at("depth").channels[0];
  const std::vector<Channel>& normal = view.planes.at("normal").channels;
  std::vector<const Channel*> layers;
  for (int k = 0; view.planes.count(layer_name("peel", k)); ++k)
    layers.push_back(&view.planes.at(layer_name("peel", k)).channels[0]);
  std::vector<long long> counts(layers.size() - 1, 0);
  const Camera& c = *view.camera;
  for (int y = grid / 2; y < frame.height(); y += grid) {
    for (int x = grid / 2; x < frame.width(); x += grid) {
      if (is_background(depth.at(x, y))) continue;
      const Point point{position_at(frame, x, y, depth.at(x, y)),
                        {normal[0].at(x, y), normal[1].at(x, y), normal[2].at(x, y)}};
      const double reach = radius * (c.orthographic ? 1 : 1 / double(depth.at(x, y)));
      for (int i = 0; i < directions * steps; ++i) {
        const double angle = 2 * M_PI * (i % directions) / directions, share = (i / directions + 0.5) / steps;
        const int to_x = x + int(std::lround(std::cos(angle) * share * reach * c.fx));
        const int to_y = y + int(std::lround(std::sin(angle) * share * reach * c.fy));
        if (to_x < 0 || to_y < 0 || to_x >= frame.width() || to_y >= frame.height()) continue;
        if (const int layer = layer_at(frame, layers, point, to_x, to_y, radius)) ++counts[size_t(layer - 1)];
      }
    }
  }
  return counts;
}

}  // namespace gloam::bench
