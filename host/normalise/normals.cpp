#include "normalise/normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "gloam/projection.h"
#include "normalise/each_row.h"

namespace gloam {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A normal of the file and the one estimated from depth, both unit, the latter in view space.
struct NormalPair {
  glm::dvec3 given, from_depth;
};

glm::dvec3 view_position(const Channel& depth, const Window& window, const Camera& camera, int x, int y) {
  const std::optional<ViewRay> ray = view_ray(camera, {window.x0 + x + 0.5, window.y0 + y + 0.5});
  return ray ? ray->at(depth.at(x, y)) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
}

/// The step on the surface from a pixel towards +x or +y, to whichever neighbour is nearer in depth; none if both are background or
/// across a depth edge.
std::optional<glm::dvec3> surface_step(const Channel& depth, const Window& window, const Camera& camera, int x, int y,
                                       int dx, int dy) {
  const int width = depth.layout().width, height = depth.layout().height;
  const float here = depth.at(x, y);
  float smallest = 0.1f * here;  // a larger jump from pixel to pixel is taken for an edge
  int side = 0;
  for (int s : {-1, 1}) {
    const int nx = x + s * dx, ny = y + s * dy;
    if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
    const float jump = std::abs(depth.at(nx, ny) - here);  // infinite towards background
    if (jump < smallest) smallest = jump, side = s;
  }
  if (side == 0) return {};
  const glm::dvec3 from = view_position(depth, window, camera, x, y);
  return double(side) * (view_position(depth, window, camera, x + side * dx, y + side * dy) - from);
}

std::optional<glm::dvec3> normal_from_depth(const Channel& depth, const Window& window, const Camera& camera, int x,
                                            int y) {
  const auto right = surface_step(depth, window, camera, x, y, 1, 0);
  const auto down = surface_step(depth, window, camera, x, y, 0, 1);
  if (!right || !down) return {};
  const glm::dvec3 normal = glm::cross(*down, *right);  // towards the eye: y runs down in the image, up in space
  const double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return normal / length;
}

/// Mean cosine between the normals estimated from depth and the given ones, taken as view space and as world space.
struct Agreement {
  double view = 0, world = 0;
  double best() const { return std::max(view, world); }
};

Agreement agreement_of(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose, bool decode) {
  Agreement sum;
  for (const NormalPair& pair : pairs) {
    const glm::dvec3 given = decode ? 2.0 * pair.given - 1.0 : pair.given;
    const double length = glm::length(given);
    if (!(length > 0)) continue;
    sum.view += glm::dot(given, pair.from_depth) / length;
    if (pose) sum.world += glm::dot(pose->world_to_view * given, pair.from_depth) / length;
  }
  const double count = double(pairs.size());
  return {sum.view / count, pose ? sum.world / count : -1};
}

/// The turn that, applied to all given normals, brings them nearest to those of the depth.
struct CommonTurn {
  double degrees = 0;
  double agreement = 0;   ///< of the turned normals
  double share_near = 0;  ///< of the pairs that the turn is of
};

/// Pairs that lie far apart are edges and curved surfaces, and say nothing of a turn.
CommonTurn common_turn(const std::vector<NormalPair>& pairs, bool decode) {
  constexpr double near = 0.8;  // cosine
  glm::dmat3 spread(0.0);
  glm::dvec3 sum(0.0);
  double count = 0;
  for (const NormalPair& pair : pairs) {
    const glm::dvec3 decoded = decode ? 2.0 * pair.given - 1.0 : pair.given;
    const glm::dvec3 given = decoded / glm::length(decoded);
    if (!(glm::dot(given, pair.from_depth) > near)) continue;
    spread += glm::dmat3(1.0) - glm::outerProduct(given, given);
    sum += glm::cross(given, pair.from_depth);
    ++count;
  }
  if (count == 0) return {};
  // Normals of one direction do not tell a turn about it: the small addition leaves it out.
  const glm::dvec3 turn = glm::inverse(spread + 1e-3 * count * glm::dmat3(1.0)) * sum;
  const double angle = glm::length(turn);
  const glm::dmat3 rotation(angle > 0 ? glm::rotate(glm::dmat4(1.0), angle, turn / angle) : glm::dmat4(1.0));
  return {glm::degrees(angle), agreement_of(pairs, Pose{rotation, {}}, decode).world, count / double(pairs.size())};
}

/// Whether normals of a camera of unknown pose are in view space. In view space they agree with depth wherever the camera stands, and
/// are not turned: on the cameras of the built-in scenes at 640x360, to 0.90 and more but for leaves and hair; smaller images have more
/// edges, and agree less. In world space they agree to 0.94 at most where the camera is turned by 20 degrees. Where half of the pairs
/// are near one another, view-space normals appear turned by 3 degrees at most, world-space normals of a camera that is turned by 6
/// degrees or more by 5 at least.
constexpr double least_turn = 4;
bool are_in_view_space(double agreement, const CommonTurn& turn) {
  return agreement >= 0.9 || (turn.share_near >= 0.5 && turn.degrees < least_turn);
}

/// What is said of normals that would agree better if all of them were turned. A field of view that is wrong by a factor of 1.7 looks
/// like a turn of up to 11 degrees.
std::string turned_in_words(double agreement, const CommonTurn& turn) {
  if (turn.degrees < least_turn || turn.agreement - agreement < 0.5 * (1 - std::cos(glm::radians(turn.degrees))))
    return "";
  return fmt::format(
      ", to {:.2f} if all were turned by {:.0f} degrees: they may be in world space, or the field of view may be "
      "another "
      "(--camera gives both)",
      turn.agreement, turn.degrees);
}

bool all_in_unit_cube(const std::vector<NormalPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const NormalPair& pair) {
    const glm::dvec3 n = pair.given;
    return std::min({n.x, n.y, n.z}) >= 0 && std::max({n.x, n.y, n.z}) <= 1;
  });
}

void decode_normals(Plane& normal) {
  for (Channel& channel : normal.channels) {
    const int width = channel.layout().width;
    for_each_row(channel.layout(), [&](int y) {
      float* row = channel.row(y);
      for (int x = 0; x < width; ++x) row[x] = 2 * row[x] - 1;
    });
  }
}

void rotate_row(float* x, float* y, float* z, int width, const glm::mat3& m) {
  for (int i = 0; i < width; ++i) {
    const float a = x[i], b = y[i], c = z[i];
    x[i] = m[0][0] * a + m[1][0] * b + m[2][0] * c;
    y[i] = m[0][1] * a + m[1][1] * b + m[2][1] * c;
    z[i] = m[0][2] * a + m[1][2] * b + m[2][2] * c;
  }
}

}  // namespace

/// One sample at a random position in each cell of a lattice, the same every time.
NormalSamples::NormalSamples(const Layout& image) {
  const int width = image.width, height = image.height;
  const int cell = std::max(1, int(std::sqrt(double(width) * height / 4096)));
  for (int cell_y = 0; cell_y < height; cell_y += cell)
    for (int cell_x = 0; cell_x < width; cell_x += cell) {
      const uint32_t random = hash(uint32_t(cell_y) * 65537u + uint32_t(cell_x));
      samples_.push_back({std::min(width - 1, cell_x + int(random % uint32_t(cell))),
                          std::min(height - 1, cell_y + int(random / 65536u % uint32_t(cell))),
                          glm::dvec3(std::numeric_limits<double>::quiet_NaN())});
    }
}

void NormalSamples::take(const Plane& normal, int first_row) {
  const int rows = normal.channels.front().layout().height;
  for (Sample& sample : samples_) {
    const int y = sample.y - first_row;
    if (y < 0 || y >= rows) continue;
    for (int c : {0, 1, 2}) sample.normal[c] = normal.channels[size_t(c)].at(sample.x, y);
  }
}

NormalForm NormalSamples::form(const Channel& depth, const Window& window, const Camera& camera,
                               std::vector<std::string>& assumed) const {
  std::vector<NormalPair> pairs;
  for (const Sample& sample : samples_) {
    if (is_background(depth.at(sample.x, sample.y))) continue;
    const double length = glm::length(sample.normal);
    if (!(length > 0) || !std::isfinite(length)) continue;
    if (const auto estimate = normal_from_depth(depth, window, camera, sample.x, sample.y))
      pairs.push_back({sample.normal, *estimate});
  }
  if (pairs.empty()) {
    assumed.push_back(
        "normals: taken as view space, as no pixel has a depth to compare them with; --normal-space says otherwise");
    return {NormalSpace::view};
  }
  Agreement agreement = agreement_of(pairs, camera.pose, false);
  const Agreement decoded = agreement_of(pairs, camera.pose, true);
  const bool encoded = all_in_unit_cube(pairs) && decoded.best() > agreement.best();
  if (encoded) agreement = decoded;
  const std::string taken = encoded ? "decoded from 0..1 and taken" : "taken";
  if (!camera.pose) {
    const CommonTurn turn = common_turn(pairs, encoded);
    if (!are_in_view_space(agreement.view, turn)) {
      assumed.push_back(fmt::format("normals: taken as world space: as view space they agree with depth only to {:.2f}",
                                    agreement.view));
      return {NormalSpace::world, encoded};
    }
    assumed.push_back(fmt::format("normals: {} as view space: they agree with depth to {:.2f}{}", taken, agreement.view,
                                  turned_in_words(agreement.view, turn)));
    return {NormalSpace::view, encoded};
  }
  const bool world = agreement.world > agreement.view;
  assumed.push_back(fmt::format(
      "normals: {} as {} space: they agree with depth to {:.2f}, as {} space to {:.2f}; --normal-space says otherwise",
      taken, world ? "world" : "view", agreement.best(), world ? "view" : "world",
      world ? agreement.view : agreement.world));
  return {world ? NormalSpace::world : NormalSpace::view, encoded};
}

NormalSpace detect_normal_space(Plane& normal, const Channel& depth, const Window& window, const Camera& camera,
                                std::vector<std::string>& assumed) {
  NormalSamples samples(normal.channels.front().layout());
  samples.take(normal, 0);
  const NormalForm form = samples.form(depth, window, camera, assumed);
  if (form.is_encoded) decode_normals(normal);
  return form.space;
}

void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera) {
  if (form.is_encoded) decode_normals(normal);
  if (form.space == NormalSpace::world) to_view_space(normal, *camera.pose);
}

long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row) {
  const int width = depth.layout().width, height = normal.channels.front().layout().height;
  long long total = 0;
#pragma omp parallel for reduction(+ : total) if (size_t(width) * size_t(height) > 65536)
  for (int y = 0; y < height; ++y) {
    const float *x = normal.channels[0].row(y), *up = normal.channels[1].row(y), *z = normal.channels[2].row(y);
    const float* row = depth.row(first_row + y);
    int count = 0;
    for (int i = 0; i < width; ++i) {
      const double a = x[i], b = up[i], c = z[i], square = a * a + b * b + c * c;
      const bool usable = (square > 0) & (square < std::numeric_limits<double>::infinity());
      count += (row[i] < infinity) & !usable;
    }
    total += count;
  }
  return total;
}

void to_view_space(Plane& normal, const Pose& pose) {
  const glm::mat3 m(pose.world_to_view);
  for_each_row(normal.channels[0].layout(), [&](int y) {
    rotate_row(normal.channels[0].row(y), normal.channels[1].row(y), normal.channels[2].row(y),
               normal.channels[0].layout().width, m);
  });
}

}  // namespace gloam
