// What stored depth means, told by plane surfaces: only with the right meaning they are plane.
#pragma once

#include <optional>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"
#include "normalise/stored_depth.h"

namespace gloam {

/// Along a row or a column of a perspective image, 1/z of a plane is a linear function of the pixel. So is what is stored, if that is 1/z or a
/// linear function of it (normalised device depth, disparities), and 1/z is the secant of the ray's angle over its length. Each segment of
/// a row or a column that is much straighter by one of these than by the others speaks for that one.
struct Straightness {
  enum Meaning { unknown, planar, along_ray, of_inverse };
  long long segments[4] = {};  ///< that speak for each meaning

  long long of_inverse_in_columns = 0;

  /// The meaning that at least `fewest` segments speak for, and at least four fifths of all.
  Meaning meaning() const;
  /// Whether both rows and columns say that 1/z is linear in the values. A ramp that a person made, whose values and not 1/z are linear
  /// along rows alone, says so too.
  bool is_of_inverse_both_ways() const;
  long long of(Meaning meaning) const { return segments[meaning]; }
  long long all() const { return segments[planar] + segments[along_ray] + segments[of_inverse]; }
  static constexpr long long fewest = 24;
};

/// Looks at some thousand segments. `depth`: values of one sign, as stored; `window`: where the rows lie in the camera's image. Of an
/// orthographic camera nothing is told.
Straightness straightness_of(const DepthRows& depth, float sign, const Background& background, const Window& window,
                             const Camera& camera);

/// Values that are linear in the distance, but not proportional to it, such as a grey between black and white.
struct LinearGrey {
  double pole =
      0;  ///< the value at distance 0: the distance is proportional to how far a value is from there; infinite: 1 / distance is
          ///< linear in the values
  bool is_both_ways = false;        ///< rows and columns speak for it
  bool is_above = false;            ///< all values: larger ones are nearer
  bool is_zero = false;             ///< as good as: the values are proportional to the distance
  long long segments = 0, all = 0;  ///< that speak for it, of those that speak at all
};

/// Values to try at which a distance is 0 or infinite, beside those that are stored, at shares of their range.
struct Poles {
  int on_a_side = 2;
  double nearest = 0, farthest = 0;
};
std::vector<double> poles_beside(double low, double high, const Poles& poles);

/// Whether plane surfaces are plane by 1/value, and less so by 1/(value - pole) with poles that lie a little beside 0.
bool is_proportional_to_distance(const DepthRows& depth, const Background& background);

/// Finds the pole, outside of all values, for which 1/(value - pole) is straight where surfaces are plane; none if they tell of none.
std::optional<LinearGrey> linear_grey_of(const DepthRows& depth, const Background& background);

}  // namespace gloam
