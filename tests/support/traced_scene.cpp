#include "support/traced_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/built_in/mesh_builder.h"

namespace gloam::test {

using glm::dvec3;
using glm::vec3;

Scene scene_with(const SceneCamera& camera) {
  Scene scene;
  scene.name = "test";
  scenes::add_material(scene, "grey", vec3(0.5f));
  scene.cameras = {camera};
  return scene;
}

Mesh& mesh_of(Scene& scene, const char* name, int material) { return scenes::add_mesh(scene, name, material); }

void add_floor(Scene& scene, float half, int material) {
  scenes::add_quad(mesh_of(scene, "floor", material), {-half, 0, half}, {half, 0, half}, {half, 0, -half},
                   {-half, 0, -half});
}

Scene corner_of_meshes(float half, int wall) {
  Scene scene = scene_with(looking_at("main", {1.2, 1.0, 1.2}, {0.2, 0, 0}, 60));
  add_floor(scene, half);
  scenes::add_quad(mesh_of(scene, "wall", wall), {0, 0, half}, {0, 0, -half}, {0, half, -half}, {0, half, half});
  return scene;
}

Frame frame_of(const Tracer& tracer, int width, int height) {
  CaptureOptions options;
  options.width = width;
  options.height = height;
  options.planes = {"normal", "position", "instance", "roughness"};
  options.views = {{"", camera_for(tracer.scene().cameras.front(), width, height), {}}};
  return std::move(capture(tracer, options).frame);
}

Comparison compared_with(const Frame& captured, const Reference& reference, const char* plane,
                         const std::function<std::optional<dvec3>(const PixelOfFrame&)>& truth) {
  const View& view = captured.views[0];
  const auto& position = view.planes.at("position").channels;
  const Channel& instance = view.planes.at("instance").channels[0];
  const std::vector<Channel>& traced = reference.frame.views[0].planes.at(plane).channels;
  Comparison result;
  double squares = 0;
  for (int y = 0; y < captured.height(); ++y) {
    for (int x = 0; x < captured.width(); ++x) {
      if (instance.at(x, y) == 0) continue;
      PixelOfFrame pixel{x, y, int(instance.at(x, y)), {}, {}};
      pixel.position = view.origin + dvec3(position[0].at(x, y), position[1].at(x, y), position[2].at(x, y));
      pixel.to_eye = glm::normalize(view.camera->pose->position - pixel.position);
      const std::optional<dvec3> expected = truth(pixel);
      if (!expected) continue;
      ++result.compared;
      for (size_t i = 0; i < traced.size(); ++i) {
        const double error = double(traced[i].at(x, y)) - (*expected)[int(i)];
        result.worst = std::max(result.worst, std::isnan(error) ? INFINITY : std::abs(error));
        result.mean += error;
        squares += error * error;
      }
    }
  }
  EXPECT_GE(4 * result.compared, captured.width() * captured.height());
  const double values = std::max(1.0, double(result.compared) * double(traced.size()));
  result.rms = std::sqrt(squares / values);
  result.mean /= values;
  std::printf("%s of %d pixels: worst %.1e, RMS %.1e, mean %+.1e; own estimate of the noise %.1e\n", plane,
              result.compared, result.worst, result.rms, result.mean, reference.noise);
  return result;
}

}  // namespace gloam::test
