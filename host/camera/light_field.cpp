#include "gloam/light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

/// Points along an edge of the screen that an image must cover: a curved screen bulges between its corners.
constexpr int edge_points = 33;

dmat3 turn_of(const OpticalModule& module) {
  const double degree = glm::pi<double>() / 180;
  const double yaw = module.yaw * degree, pitch = module.pitch * degree;
  const dvec3 right(std::cos(yaw), 0, -std::sin(yaw));
  const dvec3 ahead(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
  return {right, glm::cross(ahead, right), ahead};
}

/// Position of the screen's front along z at x: 0 or less.
double depth_of_screen(const LightFieldDisplay& display, double x) {
  if (!display.screen_radius) return 0;
  const double r = *display.screen_radius;
  return std::sqrt(std::max(0.0, r * r - x * x)) - r;
}

/// The part of a module's image that the screen covers, as tangents to the right and up.
struct Span {
  dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

Span span_of(const LightFieldDisplay& display, const OpticalModule& module, const dmat3& turn,
             const std::string& name) {
  Span span;
  for (int i = 0; i < edge_points; ++i) {
    for (int j = 0; j < edge_points; ++j) {
      const double x = (double(i) / (edge_points - 1) - 0.5) * display.screen_width;
      const double y = (double(j) / (edge_points - 1) - 0.5) * display.screen_height;
      const dvec3 seen = glm::transpose(turn) * (dvec3(x, y, depth_of_screen(display, x)) - module.position);
      // Limit of 85 degrees: beyond it, a pixel in the middle is a hundredth of one at the border.
      if (!(seen.z > 0.087 * glm::length(seen)))
        throw Error("display '{}': {} cannot light the whole screen: a part of it lies over 85 degrees off its axis",
                    display.name, name);
      span.low = glm::min(span.low, dvec2(seen) / seen.z);
      span.high = glm::max(span.high, dvec2(seen) / seen.z);
    }
  }
  return span;
}

/// World to view is the rotation for which physical = upper triangular * view, with depth alone in the last row.
struct Turned {
  dmat3 world_to_view, to_physical;
};

Turned turned(const dmat3& linear) {
  const dmat3 rows = glm::transpose(linear);
  const auto at_right_angles = [](const dvec3& v, const dvec3& z) { return glm::normalize(v - glm::dot(v, z) * z); };
  // Twice: if the rows are close together, the first step leaves the rounding error of their difference.
  const dvec3 z = glm::normalize(rows[2]), y = at_right_angles(at_right_angles(rows[1], z), z), x = glm::cross(y, z);
  const dmat3 world_to_view = glm::transpose(dmat3(x, y, z));
  dmat3 to_physical = linear * glm::transpose(world_to_view);
  // Elements that are zero but for rounding would turn a straight image into a skewed one.
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (column < row || std::abs(to_physical[column][row]) < 1e-12 * std::abs(to_physical[row][row]))
        to_physical[column][row] = 0;
  return {world_to_view, to_physical};
}

bool is_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Checks that the results are finite: sizes and positions may be any numbers.
void check_numbers(const LightFieldDisplay& display, const std::string& name, const Camera& camera) {
  const dmat3& axes = camera.slits->to_physical;
  const bool projects = std::isfinite(camera.fx) && std::isfinite(camera.fy) && camera.fx > 0 && camera.fy > 0 &&
                        std::isfinite(camera.cx) && std::isfinite(camera.cy);
  if (projects && is_finite(axes[0]) && is_finite(axes[1]) && is_finite(axes[2]) && is_finite(camera.pose->position))
    return;
  throw Error("display '{}': {}, the screen and the world are too far apart in size to be computed with", display.name,
              name);
}

}  // namespace

std::vector<std::string> module_names(const LightFieldDisplay& display) {
  const size_t count = display.modules.size();
  const size_t digits = std::max(size_t(2), std::to_string(count - 1).size());
  std::vector<std::string> names;
  for (size_t i = 0; i < count; ++i) names.push_back(fmt::format("module{:0{}}", i, digits));
  return names;
}

std::vector<std::pair<std::string, Camera>> module_cameras(const LightFieldDisplay& display, const Window& window) {
  if (!display.world)
    throw Error("display '{}': does not say which part of the world it shows; give region_of_interest.world",
                display.name);
  const Turned axes = turned(display.world->linear);
  const dvec3 middle_of_line(0, display.observer_height, display.observer_distance);
  const Pose pose{axes.world_to_view, display.world->origin + glm::inverse(display.world->linear) * middle_of_line};
  const auto text = std::make_shared<const std::string>(text_of(display));
  const std::vector<std::string> names = module_names(display);
  std::vector<std::pair<std::string, Camera>> cameras;
  for (size_t i = 0; i < names.size(); ++i) {
    const OpticalModule& module = display.modules[i];
    TwoSlits slits{axes.to_physical,     display.observer_height, display.observer_distance,
                   display.screen_width, display.screen_height,   display.screen_radius,
                   module.position,      turn_of(module),         text};
    const Span span = span_of(display, module, slits.turn, names[i]);
    Camera camera;
    camera.fx = window.width() / (span.high.x - span.low.x);
    camera.fy = window.height() / (span.high.y - span.low.y);
    camera.cx = window.x0 - span.low.x * camera.fx;
    camera.cy = window.y0 + span.high.y * camera.fy;
    camera.pose = pose;
    camera.slits = std::make_shared<const TwoSlits>(slits);
    camera.far = depth_of_slit(camera);
    camera.source = "display '" + display.name + "'";
    check_numbers(display, names[i], camera);
    cameras.emplace_back(names[i], camera);
  }
  return cameras;
}

LightFieldDisplay fitted_to(LightFieldDisplay display, const Camera& camera, const Window& window, double depth) {
  const double reach = camera.orthographic ? 1 : depth, height = window.height() / camera.fy * reach;
  const double across = display.screen_height / height, along = display.observer_distance / depth;
  // What the middle of the image shows at the depth becomes the middle of the screen, even if the observers are higher.
  const double x = (0.5 * (window.x0 + window.x1) - camera.cx) / camera.fx * reach;
  const double y = (camera.cy - 0.5 * (window.y0 + window.y1)) / camera.fy * reach;
  const dvec3 per_z(across * x / depth, (across * y + display.observer_height) / depth, along);
  WorldToPhysical world;
  world.linear = dmat3(dvec3(across, 0, 0), dvec3(0, across, 0), per_z) * camera.pose->world_to_view;
  const dvec3 middle_of_line(0, display.observer_height, display.observer_distance);
  world.origin = camera.pose->position - glm::inverse(world.linear) * middle_of_line;
  display.world = world;
  return display;
}

}  // namespace gloam
