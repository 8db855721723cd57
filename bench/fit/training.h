// Frames of built-in scenes from random cameras, with ray-traced truth: the material that coefficients are fitted to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/scene/scene.h"

namespace gloam::bench {

struct TrainingOptions {
  int width = 640, height = 360;
  int frames = 7;                              ///< of each scene
  int pixels = 2500;                           ///< of each frame, that are fitted to
  int rays = 256;                              ///< for the truth of each of these
  bool with_layers = false;                    ///< also back_depth, peeled layers and stochastic depths
  double least_pixels = 22, most_pixels = 95;  ///< reach of the radius at the median depth
  uint64_t seed = 1;
  std::filesystem::path folder;  ///< keeps the frames; those that are there already are read
  std::function<void(const std::string& file)> progress = {};  ///< before a frame is made
};

struct TrainingFrame {
  double radius = 0;               ///< scene units
  Frame frame;                     ///< depth, normal, the planes of `with_layers`, and `ao`, the truth at `pixels`
  std::vector<glm::ivec2> pixels;  ///< random ones that show a surface, the same each time
};

/// A built-in scene, or one from a file.
struct TrainingScene {
  std::string name;  ///< as a user types it
  std::string kind;  ///< of a built-in scene (SceneRecipe), else "own"
};

/// Frames of a scene: cameras stand between one of the scene's own and a surface that it sees, and look at another such surface.
/// Throws Error for a scene without cameras, and if no camera sees enough of the scene.
std::vector<TrainingFrame> training_frames(const TrainingScene& scene, const TrainingOptions& options);

}  // namespace gloam::bench
