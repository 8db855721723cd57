// Hard case 19: reflections with degenerate directions, and probabilities near zero or huge.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

constexpr double brightest = 1e4;

/// Normals towards the eye, across the view (n.v = 0), away from it, along the rows and columns of the image, and halfway
/// between: rays return to the eye, run along the screen and leave the image at its border.
glm::dvec3 normal_of(int kind, const glm::dvec3& to_eye) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), to_eye)), up = glm::cross(to_eye, right);
  const glm::dvec3 normals[] = {to_eye,
                                right,
                                up,
                                -right,
                                glm::normalize(to_eye + right),
                                glm::normalize(to_eye - up),
                                glm::normalize(1e-4 * to_eye + up),
                                glm::normalize(right - 0.5 * to_eye),
                                glm::dvec3(0, 0, 1)};
  return normals[kind % 9];
}

Frame frame_of(const Technique& technique, const Shot& shot) {
  Frame frame = shoot(shot, room());
  for (const char* plane : {"color", "roughness", "reflectance"}) plane_of(frame, plane);
  plan_for(technique, frame);  // adds invented planes and the second view
  const float roughnesses[] = {0, 1e-3f, 0.0299f, 0.03f, 0.031f, 0.1f, 0.5f, 1};
  for (View& view : frame.views) {
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        if (is_background(view.planes.at("depth").channels[0].at(x, y))) continue;
        const glm::dvec3 normal =
            normal_of(x / 3 + y / 5, -glm::normalize(ray_through(shot, x + 0.5, y + 0.5).direction));
        for (size_t i = 0; i < 3; ++i) {
          view.planes.at("normal").channels[i].at(x, y) = float(normal[int(i)]);
          view.planes.at("reflectance").channels[i].at(x, y) = (x + y) % 7 == 0 ? 1 : 0.04f;
          // One pixel in a few hundred is a lamp: improbable bright hits make fireflies.
          view.planes.at("color").channels[i].at(x, y) = (x * 7 + y * 13) % 311 == 0 ? float(brightest) : 0.1f;
        }
        view.planes.at("roughness").channels[0].at(x, y) = roughnesses[(x / 2 + y) % 8];
      }
    }
  }
  return frame;
}

/// Relative excess of a reflection over the brightest radiance, or the amount by which radiance or confidence is below 0.
Measured beyond_bounds(const Frame& outputs) {
  Measured worst(0.0);
  for (const View& view : outputs.views) {
    const Plane* plane = view.find("reflection");
    if (!plane) continue;  // techniques for the first of two views make only its plane
    for (size_t i = 0; i < plane->channels.size(); ++i) {
      const double most = i < 3 ? brightest : 1;
      for (int y = 0; y < outputs.height(); ++y) {
        for (int x = 0; x < outputs.width(); ++x) {
          const double value = plane->channels[i].at(x, y), beyond = std::max(value / most - 1, -value);
          if (beyond > worst.value)
            worst = {beyond, Place{view.name, "reflection", x, y, fmt::format("{} in channel {}", value, i)}};
        }
      }
    }
  }
  return worst;
}

/// Whether the technique makes reflections; notes why not.
bool reflects(Probe& probe) {
  const std::vector<std::string>& made = gloam::outputs_of(probe.technique());
  if (std::find(made.begin(), made.end(), "reflection") != made.end()) return true;
  probe.passes_over("makes no reflection");
  return false;
}

void at_their_limits(Probe& probe) {
  if (!reflects(probe)) return;
  for (const Shot& shot : usual_shots()) {
    Lazy<Frame> frame([&] { return frame_of(probe.technique(), shot); });
    for (const Settings& setting : {Settings{}, Settings{{"max_roughness", "1"}}, Settings{{"environment_r", "100"}},
                                    Settings{{"max_distance", "0"}}, Settings{{"bias", "0"}, {"thickness", "inf"}}}) {
      for (const RunOptions& way : probe.two_ways()) {
        if (!probe.tries(fmt::format("{}, {}, {}", text_of(setting), text_of(shot.camera), text_of(way)))) continue;
        Frame copy = clone(frame.get());
        const Frame out = probe.outputs(copy, setting, way);
        probe.measure_violation("value out of its range", out);
        probe.measure("brighter than the brightest that could be reflected, or darker than nothing", beyond_bounds(out),
                      1e-5);
      }
    }
  }
}

// --- A mirror

/// A mirror as a floor, one unit below the eye, that ends at a wall four units away; the eye looks down.
constexpr double down = 0.35, floor_height = -1, wall_distance = 4, square = 0.5;

glm::dvec3 turned(const glm::dvec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x, c * v.y - s * v.z, c * v.z + s * v.y};
}

/// The ray in the room's own space, where the floor is level.
EyeRay in_room(const EyeRay& ray) { return {turned(ray.origin, -down), turned(ray.direction, -down)}; }

std::optional<Surface> mirror_room(const EyeRay& eye) {
  const EyeRay ray = in_room(eye);
  const double to_wall = (-wall_distance - ray.origin.z) / ray.direction.z;
  const double to_floor =
      ray.direction.y < 0 ? (floor_height - ray.origin.y) / ray.direction.y : std::numeric_limits<double>::infinity();
  if (to_floor < to_wall) return Surface{to_floor, turned({0, 1, 0}, down)};
  return Surface{to_wall, turned({0, 0, 1}, down)};
}

double checker(const glm::dvec3& p) {
  return (long(std::floor(p.x / square)) + long(std::floor(p.y / square))) & 1 ? 1 : 0.25;
}

double from_edge(const glm::dvec3& p) {
  const auto off = [](double v) { return std::abs(v / square - std::round(v / square)) * square; };
  return std::min(off(p.x), off(p.y));
}

/// Whether the image shows a point of the wall, two pixels from its border at least.
bool shows(const Shot& shot, const glm::dvec3& room) {
  const glm::dvec3 p = turned(room, down);
  const double lateral = shot.camera.orthographic ? 1 : -p.z;
  const double x = shot.camera.cx + shot.camera.fx * p.x / lateral, y = shot.camera.cy - shot.camera.fy * p.y / lateral;
  return x > 2 && y > 2 && x < shot.width - 2 && y < shot.height - 2;
}

Frame mirror_frame(const Technique& technique, const Shot& shot) {
  Frame frame = shoot(shot, mirror_room);
  for (const char* plane : {"color", "roughness", "reflectance"}) plane_of(frame, plane);
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5), there = in_room(ray);
      const glm::dvec3 point = there.origin + mirror_room(ray)->depth * there.direction;
      const bool is_mirror = point.y < floor_height + 1e-6;
      for (size_t i = 0; i < 3; ++i) {
        plane_of(frame, "color").channels[i].at(x, y) = is_mirror ? 0 : float(checker(point));
        plane_of(frame, "reflectance").channels[i].at(x, y) = is_mirror ? 1 : 0;
      }
      plane_of(frame, "roughness").channels[0].at(x, y) = 0;
    }
  }
  plan_for(technique, frame);  // adds invented planes and the second view
  return frame;
}

/// Where the floor mirrors the inside of a square of the wall, it has the square's colour.
void mirror_is_exact(Probe& probe) {
  if (!reflects(probe)) return;
  for (const Shot& shot : {perspective(80, 60, 70), orthographic(80, 60, 5)}) {
    const double pixel = (shot.camera.orthographic ? 1 : wall_distance) / shot.camera.fx;
    for (const RunOptions& way : probe.two_ways()) {
      if (!probe.tries(fmt::format("a mirror under a checker wall, {}, {}", text_of(shot.camera), text_of(way))))
        continue;
      Frame frame = mirror_frame(probe.technique(), shot);
      const Frame out = probe.outputs(frame, {{"fade_border", "0"}}, way);
      const std::vector<Channel>& reflection = out.views[0].find("reflection")->channels;
      Measured worst(0.0);
      int compared = 0;
      for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
          const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5), there = in_room(ray);
          glm::dvec3 point = there.origin + mirror_room(ray)->depth * there.direction, on = there.direction;
          if (point.y > floor_height + 1e-6) continue;
          on.y = -on.y;
          point += on * ((-wall_distance - point.z) / on.z);
          if (!shows(shot, point) || from_edge(point) < 1.5 * pixel) continue;
          ++compared;
          const double error = std::abs(double(reflection[0].at(x, y)) - checker(point));
          if (error > worst.value)
            worst = {error, Place{out.views[0].name, "reflection", x, y,
                                  fmt::format("{} against {}", reflection[0].at(x, y), checker(point))}};
        }
      }
      probe.measure("mirror: difference to the colour that a ray meets", worst, 1e-5);
      probe.measure("mirror: too few pixels to compare", compared < 200 ? 1.0 : 0.0, 0);
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> reflections() {
  return {{19,
           "reflections at their limits",
           "Rays towards the camera, along the screen and out of its border, surfaces seen edge-on, roughness 0 and 1, "
           "and lamps of 1e4 give finite reflections, none brighter than the brightest that could be reflected; a "
           "mirror shows the colours that its rays meet.",
           {at_their_limits, mirror_is_exact}}};
}

}  // namespace case_files
}  // namespace gloam::stress
