#include "set/hard_frames.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "gloam/planes.h"
#include "stress/frames.h"
#include "stress/surfaces.h"

namespace gloam::sets {
namespace {

using stress::EyeRay;
using stress::Shot;

constexpr double pi = std::numbers::pi, endless = std::numeric_limits<double>::infinity();

/// Openness of a surface, by its point in view space.
using Openness = std::function<double(const glm::dvec3& point)>;

Openness open() {
  return [](const glm::dvec3&) { return 1.0; };
}

/// Half the area of a unit disc between its middle line and a parallel to it at `u`, 0 to 1: that of x = 0 .. u below the circle.
double under_circle(double u) {
  u = std::min(u, 1.0);
  return 0.5 * (u * std::sqrt(1 - u * u) + std::asin(u));
}

struct Kind {
  std::string name, help;
  Shot (*shot)(int width, int height);
  stress::Scene (*scene)();
  Openness (*openness)(double radius);
  double far_away = 0;  ///< the camera's place in the world, on each axis
  int unit = 0;         ///< all lengths are multiplied by two to this power
};

Shot usual(int width, int height) { return stress::perspective(width, height); }
Shot parallel(int width, int height) { return stress::orthographic(width, height, 4); }

stress::Scene grazed() { return stress::tilted_plane(4, 80 * pi / 180, pi / 2); }
stress::Scene turned() { return stress::tilted_plane(4, 1, 0.7); }
stress::Scene right_angle() { return stress::corner(); }
stress::Scene patch() { return stress::within(stress::tilted_plane(4, 0.5, 2), 1.2, 0.7); }
stress::Scene single_ball() { return stress::ball({0.2, 0.1, -4}, 1); }
stress::Scene wall_before_wall() { return stress::step(0.25); }

/// Both walls of `stress::corner`: the line where they meet runs across at depth 4.
Openness in_right_angle(double radius) {
  return
      [radius](const glm::dvec3& point) { return ao_beside_wall(std::hypot(point.y, point.z + 4), endless, radius); };
}

/// The lower of the two walls of `stress::step`, left of the step; the upper one is convex.
Openness beside_step(double radius) {
  return [radius](const glm::dvec3& point) { return point.x < 0 ? ao_beside_wall(-point.x, 0.25, radius) : 1.0; };
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"plane", "a plane seen at a grazing angle is open to its border", usual, grazed, [](double) { return open(); }},
      {"parallel-plane", "the same of an orthographic camera", parallel, turned, [](double) { return open(); }},
      {"far-plane", "a plane ten million units from the origin of the world", usual, turned,
       [](double) { return open(); }, 1e7},
      {"patch", "a plane before nothing: the background hides nothing", usual, patch, [](double) { return open(); }},
      {"ball", "a convex body before nothing is open everywhere", usual, single_ball, [](double) { return open(); }},
      {"corner", "two walls at a right angle", usual, right_angle, in_right_angle},
      {"parallel-corner", "the same of an orthographic camera", parallel, right_angle, in_right_angle},
      {"far-corner", "the same ten million units from the origin of the world", usual, right_angle, in_right_angle,
       1e7},
      {"giant-corner", "the same a million times as large", usual, right_angle, in_right_angle, 0, 20},
      {"step", "a step that an orthographic camera sees from above: no pixel shows its side", parallel,
       wall_before_wall, beside_step},
  };
  return all;
}

const Kind& kind_of(const std::string& name) {
  for (const Kind& kind : kinds()) {
    if (kind.name == name) return kind;
  }
  throw std::out_of_range(name);
}

Frame truth_for(const Frame& frame, const Shot& shot, const Openness& openness) {
  Frame truth = without_planes(frame);
  const Channel& depth = frame.views[0].planes.at("depth").channels[0];
  truth.views[0].planes["depth"] = frame.views[0].planes.at("depth").clone();
  Channel& ao = stress::plane_of(truth, "ao").channels[0];
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (is_background(depth.at(x, y))) continue;
      const EyeRay ray = stress::ray_through(shot, x + 0.5, y + 0.5);
      ao.at(x, y) = float(openness(stress::point_at(ray, double(depth.at(x, y)))));
    }
  }
  return truth;
}

}  // namespace

/// Nusselt's analogue: directions of a hemisphere, projected onto the floor's unit disc, have as their share of the cosine-weighted
/// hemisphere their share of the disc's area. A direction (x, y, z) with x towards the wall meets it after distance / x, at the height
/// z * distance / x. So the closed part is x > distance / radius, without an ellipse where rays pass over the wall.
double ao_beside_wall(double distance, double height, double radius) {
  const double nearest = distance / radius;
  if (nearest >= 1) return 1;
  double closed = under_circle(1) - under_circle(nearest);
  if (std::isfinite(height)) {
    const double stretch = std::hypot(1, height / distance);
    closed -= (under_circle(1) - under_circle(stretch * nearest)) / stretch;
  }
  return 1 - 2 / pi * closed;
}

const std::vector<std::string>& hard_frame_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kinds()) all.push_back(kind.name);
    return all;
  }();
  return names;
}

std::string help_of_hard_frame(const std::string& name) { return kind_of(name).help; }

HardFrame hard_frame(const std::string& name, int width, int height, double radius) {
  const Kind& kind = kind_of(name);
  const Shot shot = kind.shot(width, height);
  HardFrame made{stress::shoot(shot, kind.scene()), {}};
  View& view = made.frame.views[0];
  view.camera->pose = Pose{glm::dmat3(1.0), glm::dvec3(kind.far_away)};
  view.camera->source = "closed form";
  view.origin = view.camera->pose->position;
  made.truth = truth_for(made.frame, shot, kind.openness(std::ldexp(radius, -kind.unit)));
  if (kind.unit != 0) {
    made.frame = stress::in_other_unit(made.frame, kind.unit);
    made.truth = stress::in_other_unit(made.truth, kind.unit);
  }
  return made;
}

}  // namespace gloam::sets
