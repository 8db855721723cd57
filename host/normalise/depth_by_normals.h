// What stored depth means, told by the normals beside it: only with the right meaning do the surfaces of the depth have these normals.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gloam/camera.h"
#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/normal_samples.h"
#include "normalise/stored_depth.h"
#include "normalise/unwrapping.h"

namespace gloam {

/// Stored values of an image's pixels, one at a time: a few thousand of them tell.
struct DepthValues {
  std::function<float(int x, int y)> at;
  int width = 0, height = 0;
};
DepthValues values_of(const DepthRows& depth);

/// Normals beside a depth, and what is stated of them.
struct NormalsBeside {
  NormalSamples samples;
  NormalConvention stated;
};

/// How distances follow from stored values.
struct DepthMeaning {
  enum Kind {
    planar,     ///< the value is the planar distance
    along_ray,  ///< the value is the distance along the ray
    inverse,    ///< the planar distance is proportional to 1 / (value - pole)
    grey,       ///< the planar distance is proportional to value - pole
  };
  Kind kind = planar;
  double pole = 0;
};

/// A meaning, and by how much the normals of the depth miss those of the frame, in degrees: a mean in which none counts more than 20.
struct ReadDepth {
  DepthMeaning meaning;
  double degrees = 0;
  double median = 0;     ///< of the same: edges and bent surfaces do not count
  double departure = 0;  ///< of the normals' convention from the plain one
  bool has_plain_axes = true;
};

struct MeaningByNormals {
  ReadDepth taken;                      ///< the plainest that no other one clearly beats
  ReadDepth planar;                     ///< the plainest of all, for comparison
  std::optional<ReadDepth> as_good_as;  ///< another kind of meaning that the normals do not rule out
  /// Planar distance, by another field of view than the camera's, in degrees across: what makes up for that agrees no better.
  std::optional<double> other_view;
  double degrees_of_other_view = 0;  ///< by which it then misses
  bool is_above = false;             ///< the pole lies above all values
  double beside_pole = 0;            ///< how near the values come to it
};

/// The meaning by which depth and normals agree, with the normals in whatever convention serves it best; none where they tell nothing: too
/// few samples on smooth surfaces, or normals that agree with no meaning. `depth`: values of one sign, as stored. A perspective camera is
/// needed. Source: along a surface, the gradient of the logarithm of the planar distance is -(n . dr) / (n . r), with the normal n, the ray
/// r and its change dr from pixel to pixel.
std::optional<MeaningByNormals> meaning_by_normals(const DepthValues& depth, float sign, const Background& background,
                                                   const Window& window, const Camera& camera,
                                                   const NormalsBeside& normals);

/// How often values of 16 bits have wrapped, by the normals: a surface that is twice as far away changes twice as much from pixel to pixel. Empty
/// where they tell nothing. `kind`: planar, or along the ray.
std::vector<TurnVote> votes_on_turns(const DepthValues& depth, DepthMeaning::Kind kind, const Window& window,
                                     const Camera& camera, const NormalsBeside& normals);

}  // namespace gloam
