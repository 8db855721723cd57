// Normals of a file or an array beside those that the depth shows, at pixels spread over the image.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// A normal as it is stored, and the unit normal of the surface that the depth shows there, in view space.
struct NormalPair {
  glm::dvec3 stored, from_depth;
};

/// Samples of normals at about 4096 pixels, one at a random place in each cell of a lattice, the same every time.
class NormalSamples {
 public:
  explicit NormalSamples(const Layout& image);
  /// Takes the samples in the rows of `normal`, which begin at the image's row `first_row`.
  void take(const Plane& normal, int first_row);
  /// Takes the samples of an array, three values for each pixel.
  void take(const float* values);

  struct Sample {
    int x, y;
    glm::dvec3 normal;  ///< as stored; NaN until taken
  };
  const std::vector<Sample>& all() const { return samples_; }

  /// The planar depth of a pixel; infinite where there is no surface.
  using DepthAt = std::function<float(int x, int y)>;
  /// The samples on smooth surfaces: beside an edge the depth tells no normal.
  std::vector<NormalPair> pairs(const DepthAt& depth, const Window& window, const Camera& camera) const;
  std::vector<NormalPair> pairs(const Channel& depth, const Window& window, const Camera& camera) const;

 private:
  Layout image_;
  std::vector<Sample> samples_;
};

}  // namespace gloam
