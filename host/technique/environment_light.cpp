#include "technique/environment_light.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <map>
#include <mutex>

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

/// Radiance that sums in kernels can hold, as kept_radiance (shared/lanes/math.h) has it.
constexpr double most_radiance = 1e20;

/// Larger maps are averaged to this width, at which the finest level still tells their texels apart.
constexpr int widest_map = 1024;

/// A point of the octahedron |x| + |y| + |z| = 1, unfolded to -1 to 1 each way (shared/rays/environment.h).
dvec3 on_octahedron(double u, double v) {
  const double z = 1 - std::abs(u) - std::abs(v);
  if (z >= 0) return {u, v, z};
  return {std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z};
}

dvec3 point_at(double column, double row, int size) { return on_octahedron(2 * column / size - 1, 2 * row / size - 1); }

/// Means of blocks of texels, weighted by solid angle, with the axes of the picture.
EnvironmentMap averaged(const EnvironmentMap& map) {
  const int block = std::max(1, (map.width() + widest_map - 1) / widest_map);
  const int width = (map.width() + block - 1) / block, height = (map.height() + block - 1) / block;
  std::vector<dvec3> sums(size_t(width) * size_t(height), dvec3(0));
  std::vector<double> weights(sums.size(), 0);
  for (int y = 0; y < map.height(); ++y) {
    const double weight = std::sin((y + 0.5) / map.height() * glm::pi<double>());
    for (int x = 0; x < map.width(); ++x) {
      const size_t to = size_t(y * height / map.height()) * size_t(width) + size_t(int64_t(x) * width / map.width());
      sums[to] += weight * dvec3(map.texels()[size_t(y) * size_t(map.width()) + size_t(x)]);
      weights[to] += weight;
    }
  }
  std::vector<vec3> texels;
  texels.reserve(sums.size());
  for (size_t i = 0; i < sums.size(); ++i) texels.emplace_back(sums[i] / weights[i]);
  return EnvironmentMap(width, height, std::move(texels), EnvironmentAxes::blender);
}

/// A level, and the solid angle of each of its texels.
struct Level {
  int size;
  std::vector<dvec3> radiance;
  std::vector<double> angles;
};

Level empty_level(int size) {
  const size_t texels = size_t(size) * size_t(size);
  return {size, std::vector<dvec3>(texels, dvec3(0)), std::vector<double>(texels, 0)};
}

/// Means over 4 x 4 points of each texel. The octahedron's faces are all as far from the middle, so that a piece of them has a solid angle in
/// proportion to 1 / distance^3.
Level finest_level(const EnvironmentMap& map) {
  constexpr int points = 4;
  Level level = empty_level(EnvironmentLight::finest);
  const double area = 4 * std::pow(1.0 / (points * level.size), 2);
  for (int i = 0; i < points * level.size; ++i) {
    for (int k = 0; k < points * level.size; ++k) {
      const dvec3 p = point_at((k + 0.5) / points, (i + 0.5) / points, level.size);
      const double angle = area / std::pow(glm::dot(p, p), 1.5);
      const size_t texel = size_t(i / points) * size_t(level.size) + size_t(k / points);
      level.radiance[texel] += angle * map.radiance(p);
      level.angles[texel] += angle;
    }
  }
  for (size_t i = 0; i < level.radiance.size(); ++i) level.radiance[i] /= level.angles[i];
  return level;
}

Level coarser(const Level& fine) {
  Level level = empty_level(fine.size / 2);
  for (int y = 0; y < fine.size; ++y) {
    for (int x = 0; x < fine.size; ++x) {
      const size_t from = size_t(y) * size_t(fine.size) + size_t(x);
      const size_t to = size_t(y / 2) * size_t(level.size) + size_t(x / 2);
      level.radiance[to] += fine.angles[from] * fine.radiance[from];
      level.angles[to] += fine.angles[from];
    }
  }
  for (size_t i = 0; i < level.radiance.size(); ++i) level.radiance[i] /= level.angles[i];
  return level;
}

/// Mean of the radiance over cosine-weighted directions about each texel of a level of `size`.
std::vector<dvec3> on_surfaces(const Level& light, int size) {
  std::vector<dvec3> directions;
  for (int y = 0; y < light.size; ++y) {
    for (int x = 0; x < light.size; ++x) directions.push_back(glm::normalize(point_at(x + 0.5, y + 0.5, light.size)));
  }
  std::vector<dvec3> result;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const dvec3 normal = glm::normalize(point_at(x + 0.5, y + 0.5, size));
      dvec3 sum(0);
      double weights = 0;
      for (size_t i = 0; i < directions.size(); ++i) {
        const double weight = std::max(glm::dot(normal, directions[i]), 0.0) * light.angles[i];
        sum += weight * light.radiance[i];
        weights += weight;
      }
      result.push_back(sum / weights);
    }
  }
  return result;
}

/// 21 bits of a float that is not negative, without its sign: relative error below 2^-14.
uint64_t bits_of(double radiance) {
  const uint32_t bits = std::bit_cast<uint32_t>(float(std::min(radiance, most_radiance)));
  return (bits + 0x1ffu + ((bits >> 10) & 1u)) >> 10;
}

/// 1, and 21 bits for each component.
void put(std::vector<float>& table, size_t pair, const dvec3& radiance) {
  const uint64_t bits = bits_of(radiance.x) << 42 | bits_of(radiance.y) << 21 | bits_of(radiance.z);
  table[2 * pair] = std::bit_cast<float>(uint32_t(bits >> 32));
  table[2 * pair + 1] = std::bit_cast<float>(uint32_t(bits));
}

/// The texel that lies beside the edge of an unfolded octahedron, one texel outside.
size_t wrapped(int x, int y, int size) {
  if (x < 0 || x >= size) {
    x = std::clamp(x, 0, size - 1);
    y = size - 1 - y;
  }
  if (y < 0 || y >= size) {
    y = std::clamp(y, 0, size - 1);
    x = size - 1 - x;
  }
  return size_t(y) * size_t(size) + size_t(x);
}

/// Texels with a border of one texel, in rows of `pitch` pairs from pair `first` on.
void put_square(std::vector<float>& table, size_t first, int pitch, const std::vector<dvec3>& texels, int size) {
  for (int y = -1; y <= size; ++y) {
    for (int x = -1; x <= size; ++x)
      put(table, first + size_t(y + 1) * size_t(pitch) + size_t(x + 1), texels[wrapped(x, y, size)]);
  }
}

/// A light, and the file's time when it was read.
struct Kept {
  std::filesystem::file_time_type time;
  std::shared_ptr<const EnvironmentLight> light;
};

}  // namespace

EnvironmentLight::EnvironmentLight(const EnvironmentMap& map) {
  std::vector<Level> levels = {finest_level(averaged(map))};
  while (levels.back().size > coarsest) levels.push_back(coarser(levels.back()));
  on_surfaces_ = on_surfaces(levels[1], of_surfaces);
  std::reverse(levels.begin(), levels.end());
  for (Level& level : levels) levels_.push_back(std::move(level.radiance));
}

EnvironmentLight::EnvironmentLight(const dvec3& radiance) : on_surfaces_(of_surfaces * of_surfaces, radiance) {
  for (int size = coarsest; size <= finest; size *= 2) levels_.emplace_back(size_t(size) * size_t(size), radiance);
}

std::vector<float> EnvironmentLight::packed(int size) const {
  const auto squares = [](int texels) { return size_t(texels + 2) * size_t(texels + 2); };
  const int pitch = size + 2;
  int rows = 0;
  for (int s = coarsest; s <= size; s *= 2) rows += s + 2;
  std::vector<float> table(2 * (squares(of_surfaces) + size_t(rows) * size_t(pitch)), 0.0f);
  put_square(table, 0, of_surfaces + 2, on_surfaces_, of_surfaces);
  size_t first = squares(of_surfaces);
  for (size_t level = 0; coarsest << level <= size; ++level) {
    const int texels = coarsest << level;
    put_square(table, first, pitch, levels_[level], texels);
    first += size_t(texels + 2) * size_t(pitch);
  }
  return table;
}

std::shared_ptr<const EnvironmentLight> environment_light(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, Kept> all;
  const std::lock_guard lock(mutex);
  std::error_code unknown;
  const auto time = file.empty() ? std::filesystem::file_time_type() : std::filesystem::last_write_time(file, unknown);
  Kept& kept = all[file];
  if (kept.light && !unknown && kept.time == time) return kept.light;
  kept.light = nullptr;
  if (!file.empty() && !environment_reader())
    throw Error("{}: environments are read from files by gloam::frames, and this program is linked without it", file);
  kept.light = file.empty()
                   ? std::make_shared<const EnvironmentLight>(dvec3(1))
                   : std::make_shared<const EnvironmentLight>(environment_reader()(file, EnvironmentAxes::blender, 0));
  kept.time = time;
  return kept.light;
}

std::vector<float> environment_rotation(const View& view, EnvironmentAxes axes, double turn_degrees) {
  const bool has_pose = view.camera && view.camera->pose;
  const glm::dmat3 to_picture = world_to_picture(has_pose ? axes : EnvironmentAxes::openexr, turn_degrees);
  const glm::dmat3 rotation = has_pose ? to_picture * glm::transpose(view.camera->pose->world_to_view) : to_picture;
  std::vector<float> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(float(rotation[column][row]));
  }
  rows.push_back(0);
  return rows;
}

}  // namespace gloam
