// Normals as a file has them, brought to view space.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// How a file stores normals: `is_encoded` as 0.5 + 0.5 n.
struct NormalForm {
  NormalSpace space = NormalSpace::view;
  bool is_encoded = false;
};

/// Normals of a file at about 4096 pixels spread over the image, by which the rest is judged.
class NormalSamples {
 public:
  explicit NormalSamples(const Layout& image);
  /// Takes those that lie in the rows that `normal` has, of the image's from `first_row` on.
  void take(const Plane& normal, int first_row);
  /// Which space they are in: the one in which they agree better with those estimated from `depth` (view-space z). Without a
  /// pose: `view` where they agree as view normals do (0.9; those of a world turned little reach 0.86), else `world`. `view`
  /// where no pixel can tell. Encoded are those with no component below 0 that agree better decoded.
  /// Appends what was found to `assumed`, in one sentence.
  NormalForm form(const Channel& depth, const Window& window, const Camera& camera,
                  std::vector<std::string>& assumed) const;

 private:
  struct Sample {
    int x, y;
    glm::dvec3 normal;  ///< NaN until taken
  };
  std::vector<Sample> samples_;
};

/// The space of normals by their samples; those that are encoded are decoded in place.
NormalSpace detect_normal_space(Plane& normal, const Channel& depth, const Window& window, const Camera& camera,
                                std::vector<std::string>& assumed);

/// From the form in the file to view space, in place.
void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera);

/// Pixels of the foreground whose normal is zero or not finite. `depth` has been through `to_view_depth`, and is of the whole
/// image where `normal` has its rows from `first_row` on.
long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row = 0);

/// Rotates world-space normals into view space, in place.
void to_view_space(Plane& normal, const Pose& pose);

}  // namespace gloam
