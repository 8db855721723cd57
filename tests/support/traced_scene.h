// Small scenes for references, their frames, and the comparison of a traced plane with closed forms.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"

namespace gloam::test {

/// A scene with one grey material (index 0) and this camera.
gloam::Scene scene_with(const SceneCamera& camera);
Mesh& mesh_of(gloam::Scene& scene, const char* name, int material = 0);
/// A square in the plane y = 0 about the origin.
void add_floor(gloam::Scene& scene, float half, int material = 0);
/// A floor and a wall at x = 0 that faces +x, both of this half size: a corner of 90 degrees. Materials: 0, and `wall`.
gloam::Scene corner_of_meshes(float half = 40, int wall = 0);

/// Planes normal, position, instance and roughness of the scene's first camera.
Frame frame_of(const Tracer& tracer, int width, int height);

/// What a frame shows at a pixel.
struct PixelOfFrame {
  int x, y, mesh;       ///< mesh: index into the scene's meshes + 1
  glm::dvec3 position;  ///< world
  glm::dvec3 to_eye;    ///< unit, world
};

struct Comparison {
  int compared = 0;
  double worst = 0, rms = 0, mean = 0;
};

/// Compares each component of a plane with `truth(pixel)`, where that is given; prints the errors. Background is not compared. At
/// least a quarter of the pixels must be compared.
Comparison compared_with(const Frame& captured, const Reference& reference, const char* plane,
                         const std::function<std::optional<glm::dvec3>(const PixelOfFrame&)>& truth);

}  // namespace gloam::test
