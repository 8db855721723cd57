// What the numbers in a file mean, and how they become gloam's: depth, background, normal space.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// Depth as found in the file to planar view-space z, in place; background to +inf.
///
/// `ray` is the distance from the eye; it needs the camera. `ndc` is window depth d in 0..1, 0 at near and 1 at far, as
/// OpenGL (after its default depth range) and Direct3D write it: z = n f / (f - d (f - n)). `reversed` is 1 at near and
/// 0 at far: z = n f / (n + d (f - n)), or n / d for an infinite far plane. Both are linear for an orthographic camera.
/// They need near, and ndc and orthographic cameras far as well, from the options or else from the camera; a reversed
/// depth without far is taken to have an infinite one. `automatic` is z.
///
/// Background: NaN, infinite, 0 and anything below 1e-30 (no denormals reach a kernel), 1e10 and more, the far plane
/// where it is known (to a rounding of float), exactly `options.background`, both compared before conversion. ndc: d <
/// 0 or d >= 1; reversed: d <= 0 or d > 1. Negative depth is background, unless all surfaces are negative: then the
/// plane is "negative z" and is flipped. `alpha`, where given, tells a surface on the near plane of ndc (d = 0) from a
/// pixel that was never drawn (d = 0 and alpha 0).
///
/// Returns the convention used ("z", "ray", "ndc", "reversed", "negative z") and appends what was assumed.
/// Throws Error naming what is missing or out of range (near, far).
std::string to_view_depth(Channel& depth, const Channel* alpha, const Window& window, const Camera& camera,
                          const ReadOptions& options, std::vector<std::string>& assumed);

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

/// The rest of the door, `normalise`, for a frame whose `depth` has already been through `to_view_depth`. `as_stored`:
/// only depths are cleaned and padding is filled (see ReadOptions).
void tidy(Frame& frame, std::optional<float> background, bool as_stored = false);

/// Pixels of the foreground whose normal is zero or not finite. `depth` has been through `to_view_depth`, and is of the whole
/// image where `normal` has its rows from `first_row` on.
long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row = 0);

/// Pixels of the foreground where all components of a plane are exactly 1.
struct Ones {
  long long ones = 0, surfaces = 0;
  /// `depth`, `first_row`: as above.
  void add(const Plane& plane, const Channel& depth, int first_row);
  /// Of the foreground; 0 where there is none.
  double share() const { return surfaces > 0 ? double(ones) / double(surfaces) : 0; }
};

/// Rotates world-space normals into view space, in place.
void to_view_space(Plane& normal, const Pose& pose);

}  // namespace gloam
