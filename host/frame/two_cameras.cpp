#include "frame/two_cameras.h"

#include <glm/geometric.hpp>
#include <limits>

#include "gloam/error.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

/// Largest distance from p at which the way back may end, pixels: "1 pixel width".
constexpr double back_check = 1;

bool sees_any(const Eye& own, const Eye& other, const CameraMotion& there, const CameraMotion& back) {
  for (int y = 0; y < own.window.height(); ++y) {
    for (int x = 0; x < own.window.width(); ++x) {
      if (is_background(own.depth.at(x, y))) continue;
      const glm::dvec2 place = pixel_of(other, there.of_point(point_of(own, x, y)));
      if (is_inside(other, place) && comes_back(own, other, back, x, y, place)) return true;
    }
  }
  return false;
}

}  // namespace

CameraMotion motion_between(const Pose& from, const Pose& to) {
  return {to.world_to_view * glm::transpose(from.world_to_view), to.world_to_view * (from.position - to.position)};
}

glm::dvec3 point_of(const Eye& eye, int x, int y) {
  const std::optional<ViewRay> ray = view_ray(eye.camera, {eye.window.x0 + x + 0.5, eye.window.y0 + y + 0.5});
  return ray ? ray->at(double(eye.depth.at(x, y))) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
}

glm::dvec2 pixel_of(const Eye& eye, const glm::dvec3& point) {
  const std::optional<glm::dvec2> place = pixel_of(eye.camera, point);
  if (!place) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  return *place - glm::dvec2(eye.window.x0, eye.window.y0);
}

bool is_inside(const Eye& eye, const glm::dvec2& place) {
  return place.x >= 0 && place.y >= 0 && place.x < eye.window.width() && place.y < eye.window.height();
}

bool comes_back(const Eye& own, const Eye& other, const CameraMotion& back, int x, int y, const glm::dvec2& place) {
  const int there_x = int(place.x), there_y = int(place.y);
  if (is_background(other.depth.at(there_x, there_y))) return false;
  const glm::dvec3 point = back.of_point(point_of(other, there_x, there_y));
  return glm::distance(pixel_of(own, point), glm::dvec2(x + 0.5, y + 0.5)) <= back_check;  // false for NaN
}

const Plane& plane_in(const View& view, const std::string& name, const Layout& layout) {
  const Plane* plane = view.find(name);
  if (!plane || plane->channels.empty()) throw Error("view '{}' has no {}", view.name, name);
  for (const Channel& channel : plane->channels) {
    const Layout& own = channel.layout();
    if (own == layout) continue;
    throw Error("'{}' of view '{}' is {}x{}, and the frame is {}x{}", name, view.name, own.width, own.height,
                layout.width, layout.height);
  }
  return *plane;
}

void check_eye(const View& view, const Layout& layout) {
  if (!view.camera || !view.camera->pose)
    throw Error("view '{}' has no camera with a pose: where its pixels lie in the other view is not known", view.name);
  plane_in(view, "depth", layout);
}

bool have_surface_in_common(const Frame& frame) {
  const Layout layout(frame.width(), frame.height());
  for (const View& view : frame.views) check_eye(view, layout);
  const View &a = frame.views[0], &b = frame.views[1];
  const Eye first{*a.camera, frame.window, a.find("depth")->channels[0]};
  const Eye second{*b.camera, frame.window, b.find("depth")->channels[0]};
  const CameraMotion there = motion_between(*a.camera->pose, *b.camera->pose);
  const CameraMotion back = motion_between(*b.camera->pose, *a.camera->pose);
  return sees_any(first, second, there, back) || sees_any(second, first, back, there);
}

}  // namespace gloam
