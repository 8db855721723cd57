// Light from far away, as a picture of all directions by longitude and latitude.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gloam {

/// How directions of the world lie in the picture. In both, the top row is up and longitude grows to the left.
///   openexr: +y is up, the middle column looks along +z and the one at a quarter of the width along +x (ImfEnvmap.h).
///   blender: +z is up, the middle column looks along +x and the one at a quarter of the width along +y.
enum class EnvironmentAxes { openexr, blender };
/// "openexr" and "blender".
const std::vector<std::pair<std::string, EnvironmentAxes>>& environment_axes();

/// Turns directions of the world into those of the picture: x where the middle column looks, y to its left, z up. `turn_degrees` as in
/// EnvironmentMap.
glm::dmat3 world_to_picture(EnvironmentAxes axes, double turn_degrees);

/// A lat-long map. A texel is an area: its centre lies half a texel from its edges, and the picture's left and right edge are the
/// same meridian. (ImfEnvmap.h puts the centres of the first and the last texels on the edge; the difference is at most half a
/// texel.)
class EnvironmentMap {
 public:
  /// `texels`: width * height, top row first; radiance. `turn_degrees`: turns the light counter-clockwise about the up axis, seen
  /// from above. Throws Error for a radiance that is negative or not finite, naming the first such texel, and UsageError for a turn
  /// that is not finite.
  EnvironmentMap(int width, int height, std::vector<glm::vec3> texels, EnvironmentAxes axes = EnvironmentAxes::openexr,
                 double turn_degrees = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<glm::vec3>& texels() const { return texels_; }

  /// Where a direction of the world, of any length, lies: x from 0 to the width, y from 0 to the height.
  glm::dvec2 place(const glm::dvec3& direction) const;
  /// The direction at a place, unit, world.
  glm::dvec3 direction(const glm::dvec2& place) const;
  /// Radiance from a direction, between the four nearest texels; the first and last row go on to the poles.
  glm::dvec3 radiance(const glm::dvec3& direction) const;

 private:
  int width_, height_;
  std::vector<glm::vec3> texels_;
  EnvironmentAxes axes_;
  double turn_;  ///< radians
};

/// Reads the map of a file.
using EnvironmentReader = EnvironmentMap (*)(const std::filesystem::path& path, EnvironmentAxes axes,
                                             double turn_degrees);

/// What reads environments where a technique's setting names a file. Planes need no files, so the room that has them sets it, exr/; null
/// in a program without that.
EnvironmentReader environment_reader();
void set_environment_reader(EnvironmentReader reader);

}  // namespace gloam
