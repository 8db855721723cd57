#include "stress/eyes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "stress/surfaces.h"

namespace gloam::stress {

Eye eye_at(const Shot& shot, const glm::dvec3& position, double turned) {
  Eye eye{shot, {}};
  eye.pose.position = position;
  eye.pose.world_to_view = glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(-turned), glm::dvec3(0, 1, 0)));
  return eye;
}

Scene seen_by(const Pose& pose, const Scene& world) {
  const glm::dmat3 to_world = glm::transpose(pose.world_to_view);
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    std::optional<Surface> seen = world({pose.position + to_world * ray.origin, to_world * ray.direction});
    if (seen) seen->normal = pose.world_to_view * seen->normal;
    return seen;
  };
}

Frame shoot_pair(const std::array<Eye, 2>& eyes, const Scene& world, const Paint& paint) {
  Frame pair;
  for (const Eye& eye : eyes) {
    const Scene scene = seen_by(eye.pose, world);
    Frame frame = shoot(eye.shot, scene);
    Channel& ao = plane_of(frame, "ao").channels[0];
    for (int y = 0; y < eye.shot.height; ++y) {
      for (int x = 0; x < eye.shot.width; ++x) {
        const EyeRay ray = ray_through(eye.shot, x + 0.5, y + 0.5);
        const std::optional<Surface> seen = scene(ray);
        if (!seen) continue;
        const glm::dvec3 point = point_at(ray, seen->depth);
        ao.at(x, y) = float(paint(eye.pose.position + glm::transpose(eye.pose.world_to_view) * point));
      }
    }
    frame.views[0].name = pair.views.empty() ? "left" : "right";
    frame.views[0].camera->pose = eye.pose;
    pair.display = frame.display;
    pair.window = frame.window;
    pair.views.push_back(std::move(frame.views[0]));
  }
  return pair;
}

void move_window(Frame& frame, int x, int y) {
  for (Window* w : {&frame.display, &frame.window}) *w = {w->x0 + x, w->y0 + y, w->x1 + x, w->y1 + y};
  for (View& view : frame.views) {
    view.camera->cx += x;
    view.camera->cy += y;
  }
}

}  // namespace gloam::stress
