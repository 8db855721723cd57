// Brings a file's normals to view space.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// The form of a file's normals. `is_encoded`: stored as 0.5 + 0.5 n.
struct NormalForm {
  NormalSpace space = NormalSpace::view;
  bool is_encoded = false;
};

/// Samples of a file's normals at about 4096 pixels spread over the image, which decide the form of all.
class NormalSamples {
 public:
  explicit NormalSamples(const Layout& image);
  /// Takes the samples in the rows of `normal`, which begin at the image's row `first_row`.
  void take(const Plane& normal, int first_row);
  /// The space in which the samples agree better with normals estimated from `depth` (view-space z). Without a pose: `view` if
  /// they agree as view-space normals do (0.9; a world turned little reaches 0.86), else `world`. `view` if no pixel can be
  /// compared. They are encoded if no component is below 0 and they agree better decoded. Appends one sentence to `assumed`.
  NormalForm form(const Channel& depth, const Window& window, const Camera& camera,
                  std::vector<std::string>& assumed) const;

 private:
  struct Sample {
    int x, y;
    glm::dvec3 normal;  ///< NaN until taken
  };
  std::vector<Sample> samples_;
};

/// Finds the space of normals from their samples; decodes encoded ones in place.
NormalSpace detect_normal_space(Plane& normal, const Channel& depth, const Window& window, const Camera& camera,
                                std::vector<std::string>& assumed);

/// Converts normals from their form in the file to view space, in place.
void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera);

/// Number of foreground pixels whose normal is zero or not finite. `depth`: after `to_view_depth`, the whole image; `normal`: its
/// rows from `first_row` on.
long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row = 0);

/// Rotates world-space normals into view space, in place.
void to_view_space(Plane& normal, const Pose& pose);

}  // namespace gloam
