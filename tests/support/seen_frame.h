// Frames of a scene in closed form, seen by a known camera and written as a renderer would: with positions, and without the camera.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam::test {

/// Turned about y by `yaw`, then about its own x by `pitch`: radians, positive to the left and upwards.
glm::dmat3 turned_view(double yaw, double pitch);

/// 320 x 180 pixels, at (3, 1.5, 7), turned both ways.
Camera known_camera();

/// Depth of waves with a box before them, at a pixel of that camera.
double wavy_depth(const glm::dvec2& pixel);

/// The point of the world that a pixel shows at a depth.
glm::dvec3 world_at(const Camera& camera, const glm::dvec2& pixel, double depth);

/// What a renderer writes of the scene.
class SeenFrame {
 public:
  Camera camera = known_camera();
  Window display{0, 0, 320, 180};
  Window data{0, 0, 320, 180};
  std::function<double(const glm::dvec2&)> depth = wavy_depth;
  glm::dvec2 sample{0.5, 0.5};  ///< place in the pixel that it shows
  std::function<bool(int, int)> is_background = [](int, int) { return false; };
  glm::vec3 background_position{0.0f};
  std::function<glm::dvec3(const glm::dvec3&)> stored = [](const glm::dvec3& p) { return p; };  ///< position as written
  std::function<double(double, double)> stored_depth = [](double z, double) {
    return z;
  };                     ///< of z and the ray's length
  bool is_half = false;  ///< positions are half floats
  std::function<void(Imf::Header&)> change = [](Imf::Header&) {};

  /// Channels that `write` can write: Z, and P and N with .X .Y .Z, in the world; a view's name may stand before or between.
  void write(const std::filesystem::path& path, const std::vector<std::string>& layers) const;
  /// The camera as a JSON for gloam.
  void write_camera(const std::filesystem::path& path) const;

 private:
  std::map<std::string, std::vector<float>> channels(const std::vector<std::string>& layers) const;
};

}  // namespace gloam::test
