// Light of an environment as kernels read it (kernels/shared/rays/environment.h).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gloam/environment_map.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/technique.h"

namespace gloam {

/// An environment map, prefiltered: its light on a surface by the surface's normal, and its radiance by direction in levels, each with
/// half as many texels a side as the one before. All of them are octahedra of the picture's directions (environment_map.h), so that
/// neither a camera nor a turn changes them.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const EnvironmentMap& map);
  /// The same radiance from every direction.
  explicit EnvironmentLight(const glm::dvec3& radiance);

  /// Texels a side of the finest and of the coarsest level, and of the light on surfaces.
  static constexpr int finest = 256, coarsest = 8, of_surfaces = 32;
  /// What the kernels read from a table for levels of up to `size` texels a side, after the rotation.
  std::vector<float> packed(int size) const;

 private:
  std::vector<std::vector<glm::dvec3>> levels_;  ///< the coarsest first
  std::vector<glm::dvec3> on_surfaces_;
};

/// The light of a file; without one even light of radiance 1. Kept until the file changes. Throws as the reader
/// of environments does (environment_map.h), and where none is set.
std::shared_ptr<const EnvironmentLight> environment_light(const std::string& file);

/// The first numbers of a kernel's table: the rotation from view space to the directions of the picture, row by row, and one that fills
/// up. Without a pose view space counts as a world with y up.
std::vector<float> environment_rotation(const View& view, EnvironmentAxes axes, double turn_degrees);

/// Gives a pass the argument `environment_light`, for levels of up to `size` texels a side.
template <typename Params>
Pass with_environment(Pass pass, const Params& p, int size) {
  const auto numbers =
      std::make_shared<const std::vector<float>>(environment_light(file_name(p.environment))->packed(size));
  const auto axes = EnvironmentAxes(p.environment_axes);
  const double turn = p.environment_turn;
  pass.defines.emplace_back("ENVIRONMENT_SIZE", size);
  pass.view_tables.emplace_back("environment_light", [=](const View& view) {
    std::vector<float> table = environment_rotation(view, axes, turn);
    table.insert(table.end(), numbers->begin(), numbers->end());
    return table;
  });
  return pass;
}

/// A note where the map's place in the world, or the map, is not known; empty where both are. `without`: the light without a map, a
/// sentence.
template <typename Params>
std::string environment_assumption(const Params& p, const View& view, const std::string& without) {
  if (p.environment == 0 && (p.environment_turn != 0 || p.environment_axes != Params::environment_axes_values::openexr))
    return "environment: environment_axes and environment_turn have no effect without a map; give " +
           option("environment", "FILE");
  if (p.environment == 0) return without;
  if (view.camera && view.camera->pose) return "";
  return "environment: the pose of the camera is unknown, so up in the image is up in the map, whose middle lies "
         "behind the camera";
}

}  // namespace gloam
