// Hard cases 4, 9, 10 and 12: mirrored images, extremes of depth, cameras of every angle, and far from the origin.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/eyes.h"
#include "stress/frames.h"
#include "stress/modules.h"
#include "stress/surfaces.h"

namespace gloam::stress {
namespace {

// --- Row 4

bool points_aside(const std::string& plane) {
  return plane_kind(plane).meaning == PlaneKind::unit_vector || plane == "position" || plane == "motion" ||
         plane.starts_with("peel_normal_x.");
}

Camera mirrored(Camera camera, const Window& window) {
  camera.cx = window.x0 + window.x1 - camera.cx;
  if (!camera.pose) return camera;
  const glm::dmat3 mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  camera.pose->position.x = -camera.pose->position.x;
  camera.pose->world_to_view = mirror * camera.pose->world_to_view * mirror;
  return camera;
}

/// The frame of a mirrored world, left and right exchanged.
Frame mirrored(const Frame& frame) {
  Frame copy = clone(frame);
  for (View& view : copy.views) {
    view.origin.x = -view.origin.x;
    for (std::optional<Camera>* camera : {&view.camera, &view.camera_before}) {
      if (*camera) *camera = mirrored(**camera, frame.window);
    }
    for (auto& [name, plane] : view.planes) {
      for (size_t i = 0; i < plane.channels.size(); ++i) {
        const float sign = i == 0 && points_aside(name) ? -1.0f : 1.0f;
        for (int y = 0; y < copy.height(); ++y) {
          float* row = plane.channels[i].row(y);
          std::reverse(row, row + copy.width());
          std::for_each(row, row + copy.width(), [&](float& value) { value *= sign; });
        }
      }
    }
  }
  return copy;
}

/// Mean over seeds, which removes jitter: jitter has no left and right on average, but its pattern has.
Frame mean_over_seeds(const Probe& probe, Frame& frame, int first, int seeds) {
  const Plan plan = plan_for(probe.technique(), frame, few_samples(probe.technique()));
  Frame sum = probe.outputs(plan, frame, {.seed = first});
  for (int seed = first + 1; seed < first + seeds; ++seed) {
    const Frame next = probe.outputs(plan, frame, {.seed = seed});
    for (size_t i = 0; i < sum.views.size(); ++i) {
      for (auto& [name, plane] : sum.views[i].planes) {
        for (size_t c = 0; c < plane.channels.size(); ++c) {
          for (int y = 0; y < sum.height(); ++y) {
            for (int x = 0; x < sum.width(); ++x)
              plane.channels[c].at(x, y) += next.views[i].find(name)->channels[c].at(x, y);
          }
        }
      }
    }
  }
  for (View& view : sum.views) {
    for (auto& [name, plane] : view.planes) {
      for (Channel& channel : plane.channels) {
        for (int y = 0; y < sum.height(); ++y) {
          for (int x = 0; x < sum.width(); ++x) channel.at(x, y) /= float(seeds);
        }
      }
    }
  }
  return sum;
}

// Compared with the noise left after so many seeds, as measured by other seeds: a sample that is not at its mirror image exceeds
// it. Results without noise differ by rounding alone.
void mirrored_image(Probe& probe) {
  const int seeds = probe.is_quick() ? 16 : 256;
  std::vector<Shot> shots = usual_shots();
  shots.push_back(perspective(80, 60));
  shots.back().camera.cx += 0.3 * shots.back().width;
  for (const Shot& shot : shots) {
    const bool is_aside = shot.camera.cx != 0.5 * shot.width;
    for (const bool with_normals : {true, false}) {
      if (!probe.tries(fmt::format("{}{}, {}, mean of {} seeds", text_of(shot.camera), is_aside ? " off axis" : "",
                                   normals_text(with_normals), seeds)))
        continue;
      Frame frame = shoot(shot, room(), with_normals);
      plan_for(probe.technique(), frame);  // adds the second view and invented planes
      Frame other = mirrored(frame);
      const Frame expected = mean_over_seeds(probe, frame, 0, seeds);
      const Difference noise = difference(mean_over_seeds(probe, frame, seeds, seeds), expected);
      const Difference d = difference(mirrored(mean_over_seeds(probe, other, 2 * seeds, seeds)), expected);
      constexpr double rounding = 1e-5;
      probe.measure("mirrored image: mean difference, over that of other seeds",
                    {d.mean / std::max(noise.mean, rounding), d.place}, probe.is_quick() ? 1.5 : 1.2);
      probe.measure("mirrored image: mean difference", {d.mean, d.place}, INFINITY);
    }
  }
}

// --- Row 9

/// Depths from the smallest to the largest that a file may have, side by side.
std::optional<Surface> any_depth(const EyeRay& ray) {
  const glm::dvec3 side = ray.origin + ray.direction;
  const int step = int(std::floor(side.x * 40) + 7 * std::floor(side.y * 40)) & 63;
  return Surface{std::pow(10.0, -30 + step * 1.05), {0, 0, 1}};
}

void extremes_of_depth(Probe& probe) {
  const std::pair<const char*, Scene> scenes[] = {{"1e-6 beside 1e6", near_and_far()}, {"1e-30 to 1e37", any_depth}};
  for (const auto& [name, scene] : scenes) {
    for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, 4), orthographic(80, 60, 1e-5)}) {
      for (const bool with_normals : {true, false}) {
        for (const RunOptions& way : probe.all_ways()) {
          if (!probe.tries(fmt::format("depths {}, {}, {}, {}", name, text_of(shot.camera), normals_text(with_normals),
                                       text_of(way))))
            continue;
          Frame frame = shoot(shot, scene, with_normals, 3.4e38f);  // none of these depths is background
          probe.measure_violation("value out of its range", probe.outputs(frame, few_samples(probe.technique()), way));
        }
      }
    }
  }
}

/// Neither the mountain nor the hand has anything of the other near it.
void nothing_near_is_open(Probe& probe) {
  if (!probe.opt_out("open").empty()) return;
  for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, 4)}) {
    for (const double length : {1e-7, 1e5}) {
      for (const RunOptions& way : probe.two_ways()) {
        if (!probe.tries(
                fmt::format("depths 1e-6 beside 1e6, lengths {}, {}, {}", length, text_of(shot.camera), text_of(way))))
          continue;
        Frame frame = shoot(shot, near_and_far());
        const Settings lengths = set_lengths(probe.technique(), frame, [&](double) { return length; });
        const Plan plan = plan_for(probe.technique(), frame, few_samples(probe.technique()) + lengths);
        if (unit_interval_outputs(plan).empty()) return probe.passes_over("makes no plane of 0..1");
        if (lengths.empty()) return probe.passes_over("has no radius");
        probe.measure("distance from open where nothing is within the radius",
                      distance_from_open(plan, probe.outputs(plan, frame, way)), 1e-6);
      }
    }
  }
}

// --- Row 10

struct Angle {
  std::string name;
  Shot shot;
};

std::vector<Angle> angles() {
  std::vector<Angle> all;
  for (const double fov : {1.0, 5.0, 20.0, 60.0, 120.0, 170.0, 179.0})
    all.push_back({fmt::format("field of view {}", fov), perspective(80, 60, fov)});
  for (const double aside : {-1.5, 0.5}) {
    Shot shot = perspective(80, 60);
    shot.camera.cx += aside * shot.width;
    shot.camera.cy -= aside * shot.height;
    all.push_back({fmt::format("off axis by {} images", aside), shot});
  }
  Shot narrow = perspective(80, 60);
  narrow.camera.fy *= 2;
  all.push_back({"pixels twice as wide as high", narrow});
  for (const double across : {1e-3, 4.0, 1e4})
    all.push_back({fmt::format("orthographic, {} units", across), orthographic(80, 60, across)});
  return all;
}

/// Largest error of a position relative to its distance from the eye.
Measured position_error(const Frame& outputs, const Frame& frame, const Shot& shot) {
  Measured worst(0.0);
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const float depth = frame.views[0].find("depth")->channels[0].at(x, y);
      if (is_background(depth)) continue;
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const glm::dvec3 truth = ray.origin + double(depth) * ray.direction;
      const std::vector<Channel>& c = outputs.views[0].find("position")->channels;
      const glm::dvec3 found(c[0].at(x, y), c[1].at(x, y), c[2].at(x, y));
      const double error = glm::length(found - truth) / glm::length(truth);
      if (error > worst.value)
        worst = {error, Place{"", "position", x, y, fmt::format("{:.3g} of its distance", error)}};
    }
  }
  return worst;
}

/// Error that half a unit in the last place of the depths can cause in a normal made from three points, radians: it moves a point
/// along its ray, which counts by how low the triangle is. The largest over a pixel's neighbours; none if the pixel lacks a
/// neighbour on either axis.
std::optional<double> rounding_of_normal(const Shot& shot, const Scene& scene, int x, int y) {
  const auto point = [&](int dx, int dy) -> std::optional<glm::dvec3> {
    if (x + dx < 0 || x + dx >= shot.width || y + dy < 0 || y + dy >= shot.height) return {};
    const EyeRay ray = ray_through(shot, x + dx + 0.5, y + dy + 0.5);
    const auto seen = scene(ray);
    return seen ? std::optional(point_at(ray, seen->depth)) : std::nullopt;
  };
  const auto here = point(0, 0);
  std::optional<double> most;
  for (const int dx : {-1, 1}) {
    for (const int dy : {-1, 1}) {
      const auto aside = point(dx, 0), above = point(0, dy);
      if (!here || !aside || !above) continue;
      const glm::dvec3 a = *aside - *here, b = *above - *here;
      const double farthest = std::max({glm::length(*here), glm::length(*aside), glm::length(*above)});
      const double height = glm::length(glm::cross(a, b)) / std::max(glm::length(a), glm::length(b));
      most = std::max(most.value_or(1e-7), 6e-8 * farthest / height);
    }
  }
  return most;
}

/// The largest angle between normals and the exact ones, relative to the effect of rounding.
Measured normal_error(const Frame& outputs, const Shot& shot, const Scene& scene) {
  Measured worst(0.0);
  const std::vector<Channel>& c = outputs.views[0].find("normal")->channels;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto rounding = rounding_of_normal(shot, scene, x, y);
      if (!rounding) continue;
      const glm::dvec3 found(c[0].at(x, y), c[1].at(x, y), c[2].at(x, y));
      const double angle = glm::length(found - scene(ray_through(shot, x + 0.5, y + 0.5))->normal);
      if (angle / *rounding > worst.value)
        worst = {angle / *rounding, Place{"", "normal", x, y, fmt::format("{:.3g} radians off", angle)}};
    }
  }
  return worst;
}

/// Whether rounded depths form a staircase: neighbouring depths are at most a thousand roundings apart.
bool depths_hardly_differ(const Shot& shot, double depth) {
  const double pixel = (shot.camera.orthographic ? 1 : depth) / std::max(shot.camera.fx, shot.camera.fy);
  return pixel < 1000 * 6e-8 * depth;
}

/// A tilted wall, for every angle of the eye: with a wrong camera it is no plane, or one of another tilt.
void cameras_of_every_angle(Probe& probe) {
  constexpr double depth = 3;
  for (const Angle& angle : angles()) {
    for (const bool with_normals : {true, false}) {
      for (const RunOptions& way : probe.two_ways()) {
        if (!probe.tries(fmt::format("{}, {}, {}", angle.name, normals_text(with_normals), text_of(way)))) continue;
        const Scene wall = tilted_plane(depth, 0.6, 0.7);
        Frame frame = shoot(angle.shot, wall, with_normals);
        const Settings lengths = set_lengths(probe.technique(), frame, [](double) { return 0.1 * depth; });
        const Plan plan = plan_for(probe.technique(), frame, few_samples(probe.technique()) + lengths);
        const Frame out = probe.outputs(plan, frame, way);
        probe.measure_violation("value out of its range", out);
        const auto makes = [&](const char* plane) {
          return std::find(plan.outputs.begin(), plan.outputs.end(), plane) != plan.outputs.end() &&
                 std::find(plan.inputs.begin(), plan.inputs.end(), plane) == plan.inputs.end();
        };
        if (!unit_interval_outputs(plan).empty() && probe.opt_out("open").empty()) {
          if (depths_hardly_differ(angle.shot, depth))
            probe.measure("a tilted wall whose depths hardly differ: distance from open", distance_from_open(plan, out),
                          INFINITY);
          else
            probe.measure("a tilted wall: distance from open", distance_from_open(plan, out), 1e-6);
        }
        if (makes("position"))
          probe.measure("error of positions, of their distance", position_error(out, frame, angle.shot), 1e-5);
        if (makes("normal"))
          probe.measure("angle to exact normals, in roundings of the depth", normal_error(out, angle.shot, wall), 4);
      }
    }
  }
}

// --- Row 12

/// The same world and eyes, moved elsewhere.
Frame moved(const Frame& frame, const glm::dvec3& by) {
  Frame copy = clone(frame);
  for (View& view : copy.views) {
    view.origin += by;
    for (std::optional<Camera>* camera : {&view.camera, &view.camera_before}) {
      if (*camera && (*camera)->pose) (*camera)->pose->position += by;
    }
  }
  return copy;
}

/// Eyes 65 mm apart; a frame before from a little aside; all planes that the technique reads.
Frame frame_of_eyes(const Technique& technique) {
  const Shot shot = perspective(80, 60);
  Frame frame = shoot_pair({eye_at(shot, {0, 0, 0}), eye_at(shot, {0.065, 0, 0}, 1)}, room(),
                           [](const glm::dvec3& world) { return 0.5 + 0.5 * std::sin(5 * world.x); });
  if (technique.views < 2) frame.views.resize(1);
  for (View& view : frame.views) {
    view.planes.erase("ao");
    view.camera_before = view.camera;
    view.camera_before->pose->position += glm::dvec3(0.02, 0.01, -0.05);
  }
  plan_for(technique, frame);
  return frame;
}

/// Whether any pass uses the world, another view or the frame before.
bool looks_beyond_its_view(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.pass.projects || takes(planned.pass, From::frame_before) || planned.technique->views > 1) return true;
  }
  const auto holds = [](const std::vector<std::string>& planes, const char* name) {
    return std::find(planes.begin(), planes.end(), name) != planes.end();
  };
  return holds(plan.inputs, "position") || holds(plan.outputs, "position");
}

// A camera's position is a double: at 1e7 it has steps of 2e-9, which is 3e-8 of the distance between two eyes. Now and then that
// moves a sample to the next pixel.
void far_from_the_origin(Probe& probe) {
  const Technique& technique = probe.technique();
  std::vector<std::pair<std::string, Frame>> frames;
  frames.emplace_back("cameras", frame_of_eyes(technique));
  if (!looks_beyond_its_view(plan_for(technique, frames[0].second)) &&
      !(technique.any_projection && technique.key_views))
    return probe.passes_over("uses nothing but its own view: no kernel gets the camera's position");
  if (technique.any_projection && technique.key_views) {
    frames.emplace_back("modules", shoot_modules(flat_display(), 80, 60, room()));
    plan_for(technique, frames.back().second);
  }
  for (auto& [name, frame] : frames) {
    const Settings reuse = name == "modules" ? Settings{{"reuse", "on"}, {"key_views", "2"}} : Settings{};
    for (const RunOptions& way : probe.two_ways()) {
      const Settings settings = few_samples(technique) + reuse;
      Lazy<Frame> expected([&] { return probe.outputs(frame, settings, way); });
      for (const double distance : {1e3, 1e7}) {
        if (!probe.tries(fmt::format("{} at {} units from the origin, {}", name, distance, text_of(way)))) continue;
        Frame far = moved(frame, distance * glm::dvec3(1, -0.2, 0.5));
        const Difference d = difference(probe.outputs(far, settings, way), expected.get());
        probe.measure("mean difference to the same at the origin", {d.mean, d.place}, 1e-4);
        probe.measure("largest difference to the same at the origin", d, INFINITY);
      }
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> cameras() {
  return {
      {4,
       "mirrored image",
       "A mirrored image, with its camera, gives the mirrored result on average over seeds: no sample pattern has a "
       "side.",
       {mirrored_image}},
      {9,
       "extremes of depth",
       "Depths of 1e-6 beside 1e6, and of 1e-30 to 1e37, overflow nothing; a point with nothing within its radius is "
       "open. (Time with denormal depths: bench/README.md.)",
       {extremes_of_depth, nothing_near_is_open}},
      {10,
       "cameras of every angle",
       "Fields of view of 1 to 179 degrees, off-axis and orthographic cameras: positions are within 1e-5 of their "
       "distance, normals as exact as depths allow, and a tilted wall reads open.",
       {cameras_of_every_angle}},
      {12,
       "far from the origin",
       "Cameras 1e7 units from the world's origin give the same results as at the origin: positions are relative.",
       {far_from_the_origin}}};
}

}  // namespace case_files
}  // namespace gloam::stress
