#include "gloam/environment_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "gloam/error.h"

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

constexpr double pi = glm::pi<double>();

/// Axes of the picture: x where the middle column looks, y to its left, z up.
dvec3 to_picture(const dvec3& world, EnvironmentAxes axes) {
  return axes == EnvironmentAxes::openexr ? dvec3(world.z, world.x, world.y) : world;
}

dvec3 to_world(const dvec3& picture, EnvironmentAxes axes) {
  return axes == EnvironmentAxes::openexr ? dvec3(picture.y, picture.z, picture.x) : picture;
}

EnvironmentReader& reader() {
  static EnvironmentReader set = nullptr;
  return set;
}

}  // namespace

const std::vector<std::pair<std::string, EnvironmentAxes>>& environment_axes() {
  static const std::vector<std::pair<std::string, EnvironmentAxes>> axes = {{"openexr", EnvironmentAxes::openexr},
                                                                            {"blender", EnvironmentAxes::blender}};
  return axes;
}

glm::dmat3 world_to_picture(EnvironmentAxes axes, double turn_degrees) {
  const double turn = turn_degrees * pi / 180, c = std::cos(turn), s = std::sin(turn);
  glm::dmat3 columns;
  for (int i = 0; i < 3; ++i) {
    dvec3 axis(0);
    axis[i] = 1;
    const dvec3 d = to_picture(axis, axes);
    columns[i] = {c * d.x + s * d.y, c * d.y - s * d.x, d.z};
  }
  return columns;
}

EnvironmentMap::EnvironmentMap(int width, int height, std::vector<vec3> texels, EnvironmentAxes axes,
                               double turn_degrees)
    : width_(width), height_(height), texels_(std::move(texels)), axes_(axes), turn_(turn_degrees * pi / 180) {
  if (!std::isfinite(turn_degrees))
    throw UsageError("an environment cannot be turned by {:g} degrees; give a finite angle", turn_degrees);
  if (width < 1 || height < 1 || texels_.size() != size_t(width) * size_t(height))
    throw Error("an environment of {} x {} texels cannot have {}", width, height, texels_.size());
  for (size_t i = 0; i < texels_.size(); ++i) {
    const vec3& t = texels_[i];
    const auto fits = [](float value) { return value >= 0 && std::isfinite(value); };
    if (fits(t.x) && fits(t.y) && fits(t.z)) continue;
    throw Error("the environment is {:g}, {:g}, {:g} at texel ({}, {}); finite radiance from 0 on is allowed", t.x, t.y,
                t.z, i % size_t(width), i / size_t(width));
  }
}

dvec2 EnvironmentMap::place(const dvec3& direction) const {
  const dvec3 d = to_picture(glm::normalize(direction), axes_);
  double turns = 0.5 - (std::atan2(d.y, d.x) - turn_) / (2 * pi);
  turns -= std::floor(turns);
  // By the arc tangent, which is exact at the poles too.
  return {turns * width_, std::atan2(std::hypot(d.x, d.y), d.z) / pi * height_};
}

dvec3 EnvironmentMap::direction(const dvec2& place) const {
  const double longitude = (0.5 - place.x / width_) * 2 * pi + turn_, from_pole = place.y / height_ * pi;
  return to_world(
      {std::sin(from_pole) * std::cos(longitude), std::sin(from_pole) * std::sin(longitude), std::cos(from_pole)},
      axes_);
}

dvec3 EnvironmentMap::radiance(const dvec3& direction) const {
  const dvec2 at = place(direction) - 0.5;
  const double left = std::floor(at.x), top = std::floor(at.y);
  const auto texel = [&](int dx, int dy) {
    const int x = (int(left) + dx + width_) % width_, y = std::clamp(int(top) + dy, 0, height_ - 1);
    return dvec3(texels_[size_t(y) * size_t(width_) + size_t(x)]);
  };
  const double u = at.x - left, v = at.y - top;
  return (1 - v) * ((1 - u) * texel(0, 0) + u * texel(1, 0)) + v * ((1 - u) * texel(0, 1) + u * texel(1, 1));
}

EnvironmentReader environment_reader() { return reader(); }

void set_environment_reader(EnvironmentReader of_files) { reader() = of_files; }

}  // namespace gloam
