#include "stress/frames.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "analytic_scene.h"
#include "base/low_discrepancy.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "gloam/projection.h"

namespace gloam::stress {
namespace {

constexpr int invented_layers = 3;

/// The number at the end of "peel.03"; 0 for other names.
int number_in(const std::string& name) {
  const std::optional<StackLayer> layer = stack_layer(name);
  return layer ? layer->number : 0;
}

/// A value of 0..1, irregular but the same every time.
float pattern(int x, int y, int component) {
  const uint32_t mixed = hash(uint32_t(x) + 4099u * uint32_t(y) + 65599u * uint32_t(component));
  return float(mixed >> 8) * 0x1p-24f;
}

/// A view's camera as a shot of the whole window.
Shot shot_of(const Frame& frame, const View& view) { return {*view.camera, frame.width(), frame.height()}; }

float invented_value(const PlaneKind& kind, const Frame& frame, const View& view, int component, int x, int y) {
  const float depth = view.find("depth")->channels[0].at(x, y);
  if (kind.meaning == PlaneKind::view_depth) return depth * (1 + 0.1f * float(number_in(kind.name)));
  if (kind.meaning == PlaneKind::unit_vector) {
    const Plane* normal = view.find("normal");
    return normal ? normal->channels[size_t(component)].at(x, y) : component == 2 ? 1.0f : 0.0f;
  }
  // Layers send light as the surface in front of them does.
  const std::optional<StackLayer> layer = stack_layer(kind.name);
  if (layer && layer->stack.starts_with("peel_normal_")) {
    const Plane* normal = view.find("normal");
    const size_t own = size_t(layer->stack.back() - 'x');
    return normal ? normal->channels[own].at(x, y) : own == 2 ? 1.0f : 0.0f;
  }
  if (kind.name == "position") {
    const EyeRay ray = ray_through(shot_of(frame, view), x + 0.5, y + 0.5);
    return is_background(depth) ? 0 : float((ray.origin + double(depth) * ray.direction)[component]);
  }
  // Whole numbers in blocks: some blocks are corners, some are not.
  if (kind.name == "outline_count") return float(((x + 40) / 80 + (y + 30) / 60) % 2 * 2);
  // Leads past every border of the image.
  if (kind.name == "motion") return 6 * pattern(x, y, component) - 3;
  if (kind.name == "history_frames") return std::floor(6 * pattern(x, y, component));
  return pattern(x, y, component);
}

}  // namespace

Shot perspective(int width, int height, double fov) {
  Shot shot{{}, width, height};
  shot.camera.fx = shot.camera.fy = 0.5 * width / std::tan(0.5 * fov * std::numbers::pi / 180);
  shot.camera.cx = 0.5 * width;
  shot.camera.cy = 0.5 * height;
  return shot;
}

Shot orthographic(int width, int height, double units_across) {
  Shot shot{{}, width, height};
  shot.camera.orthographic = true;
  shot.camera.fx = shot.camera.fy = width / units_across;
  shot.camera.cx = 0.5 * width;
  shot.camera.cy = 0.5 * height;
  return shot;
}

std::vector<Shot> usual_shots() { return {perspective(80, 60), orthographic(80, 60, 4)}; }

Shot fine_shot() { return perspective(144, 108); }

std::vector<Shot> odd_shots() { return {perspective(93, 61), orthographic(93, 61, 4)}; }

EyeRay ray_through(const Shot& shot, double x, double y) {
  if (shot.camera.slits) {
    const std::optional<ViewRay> ray = view_ray(shot.camera, {x, y});
    const glm::dvec3 nowhere(std::numeric_limits<double>::quiet_NaN());
    return ray ? EyeRay{ray->start, ray->per_depth} : EyeRay{nowhere, nowhere};
  }
  const glm::dvec3 aside((x - shot.camera.cx) / shot.camera.fx, (shot.camera.cy - y) / shot.camera.fy, 0);
  const glm::dvec3 ahead(0, 0, -1);
  return shot.camera.orthographic ? EyeRay{aside, ahead} : EyeRay{glm::dvec3(0), aside + ahead};
}

Scene tilted_plane(double depth, double tilt, double turn) {
  const glm::dvec3 normal(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
  const glm::dvec3 point(0, 0, -depth);
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const double facing = glm::dot(normal, ray.direction);
    const double t = glm::dot(normal, point - ray.origin) / facing;
    if (!(facing < 0) || !(t > 0)) return {};
    return Surface{t, normal};
  };
}

Scene within(Scene scene, double half_x, double half_y) {
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    const std::optional<Surface> seen = scene(ray);
    if (!seen) return {};
    const glm::dvec3 point = ray.origin + seen->depth * ray.direction;
    return std::abs(point.x) <= half_x && std::abs(point.y) <= half_y ? seen : std::nullopt;
  };
}

Scene solids(const analytic::Scene& scene) {
  return [scene](const EyeRay& ray) -> std::optional<Surface> {
    const double length = glm::length(ray.direction);
    const auto hit = analytic::first_hit(scene, {ray.origin, ray.direction / length});
    if (!hit) return {};
    return Surface{hit->distance / length, hit->normal};
  };
}

Scene looking_down(Scene scene, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [](const glm::dvec3& v, double c, double s) {
    return glm::dvec3(v.x, c * v.y + s * v.z, c * v.z - s * v.y);
  };
  return [=](const EyeRay& ray) -> std::optional<Surface> {
    std::optional<Surface> seen = scene({turned(ray.origin, c, s), turned(ray.direction, c, s)});
    if (seen) seen->normal = turned(seen->normal, c, -s);
    return seen;
  };
}

Scene room() {
  analytic::Scene scene;
  const glm::vec3 grey(0.5f);
  scene.add(analytic::make_box({-9, -2, -9}, {1.1, -0.6, 9}), grey);
  scene.add(analytic::make_box({-9, -2, -9}, {0.9, 0.5, -3.2}), grey);
  scene.add(analytic::make_box({-9, -2, -9}, {-1.2, 9, 9}), grey);
  scene.add(analytic::make_box({0.3, -2, -3.0}, {0.9, -0.4, -2.0}), grey);
  scene.add(analytic::make_sphere({-0.3, -0.3, -2.5}, 0.3), grey);
  return looking_down(solids(scene), 0.35);
}

Frame blank(const Shot& shot) {
  Frame frame;
  frame.display = frame.window = {0, 0, shot.width, shot.height};
  frame.views.resize(1);
  frame.views[0].camera = shot.camera;
  return frame;
}

Frame shoot(const Shot& shot, const Scene& scene, bool with_normals, std::optional<float> background) {
  Frame frame = blank(shot);
  plane_of(frame, "depth");
  if (with_normals) plane_of(frame, "normal");
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const std::optional<Surface> seen = std::isnan(ray.direction.z) ? std::nullopt : scene(ray);
      plane_of(frame, "depth").channels[0].at(x, y) = seen ? float(seen->depth) : infinity;
      if (!with_normals) continue;
      for (int i = 0; i < 3; ++i)
        plane_of(frame, "normal").channels[size_t(i)].at(x, y) = seen ? float(seen->normal[i]) : 0;
    }
  }
  normalise(frame, background);
  return frame;
}

Plane& plane_of(View& view, const Layout& layout, const std::string& name) {
  Plane& plane = view.planes[name];
  if (plane.channels.empty()) plane = empty_plane(name, layout);
  return plane;
}

Plane& plane_of(Frame& frame, const std::string& name) {
  return plane_of(frame.views[0], Layout(frame.width(), frame.height()), name);
}

std::vector<std::string> plane_names(const Frame& frame) {
  std::vector<std::string> names;
  for (const auto& [name, plane] : frame.views[0].planes) names.push_back(name);
  return names;
}

Frame clone(const Frame& frame) {
  Frame copy = without_planes(frame);
  for (size_t i = 0; i < frame.views.size(); ++i) {
    for (const auto& [name, plane] : frame.views[i].planes) copy.views[i].planes.emplace(name, plane.clone());
  }
  return copy;
}

Frame in_other_unit(const Frame& frame, int k) {
  Frame copy = clone(frame);
  for (View& view : copy.views) {
    view.origin *= std::ldexp(1.0, k);
    for (std::optional<Camera>* camera : {&view.camera, &view.camera_before}) {
      if (!*camera) continue;
      Camera& c = **camera;
      if (c.pose) c.pose->position *= std::ldexp(1.0, k);
      if (c.orthographic) c.fx = std::ldexp(c.fx, -k), c.fy = std::ldexp(c.fy, -k);
    }
    for (auto& [name, plane] : view.planes) {
      const PlaneKind::Meaning meaning = plane_kind(name).meaning;
      if (meaning != PlaneKind::view_depth && meaning != PlaneKind::length && name != "position") continue;
      for (Channel& channel : plane.channels) {
        for (int y = 0; y < copy.height(); ++y) {
          for (int x = 0; x < copy.width(); ++x) channel.at(x, y) = std::ldexp(channel.at(x, y), k);
        }
      }
    }
  }
  return copy;
}

void invent_plane(Frame& frame, const std::string& name) {
  if (is_stack(name)) {
    for (int number = 0; number < invented_layers; ++number) invent_plane(frame, layer_name(name, number));
    return;
  }
  const PlaneKind kind = plane_kind(name);
  for (View& view : frame.views) {
    Plane& plane = plane_of(view, Layout(frame.width(), frame.height()), name);
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x)
          plane.channels[i].at(x, y) = invented_value(kind, frame, view, int(i), x, y);
      }
    }
  }
  normalise(frame);
}

}  // namespace gloam::stress
