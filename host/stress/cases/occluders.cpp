// Hard cases 15, 16 and 17: an added occluder, surfaces with known ambient occlusion, and surfaces thinner than a pixel.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "analytic_scene.h"
#include "base/low_discrepancy.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/frames.h"
#include "stress/surfaces.h"

namespace gloam::stress {
namespace {

bool holds(const std::vector<std::string>& planes, const std::string& name) {
  return std::find(planes.begin(), planes.end(), name) != planes.end();
}

/// The plane of ambient occlusion that a technique estimates, before its filter if it has one; empty for other techniques, such
/// as filters.
std::string plane_of_ao(const Technique& technique) {
  if (holds(technique.reads, "ao_raw")) return "";
  for (const char* name : {"ao_raw", "ao"}) {
    if (holds(technique.writes, name)) return name;
  }
  return "";
}

/// Whether the technique computes AO from the surroundings of a point; notes why not.
bool makes_ao(Probe& probe) {
  if (!plane_of_ao(probe.technique()).empty()) return true;
  probe.passes_over("estimates no ambient occlusion");
  return false;
}

const Channel& filtered(const Frame& outputs) {
  const Plane* ao = outputs.views[0].find("ao");
  return (ao ? ao : outputs.views[0].find("ao_raw"))->channels[0];
}

/// No falloff: an occluder counts in full within the radius.
Settings without_falloff(const Plan& plan) {
  Settings settings;
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.technique->parameters) {
      const bool has_none = std::find(p.choices.begin(), p.choices.end(), "none") != p.choices.end();
      if (p.name == "falloff" && has_none) settings.emplace_back(planned.technique->name + ".falloff", "none");
    }
  }
  return settings;
}

/// The nearest surface, and all of them as the layers of `peel`.
Frame with_all_layers(const Shot& shot, const std::vector<Scene>& scenes) {
  Frame frame = shoot(shot, nearest_of(scenes));
  for (size_t k = 0; k < scenes.size(); ++k) {
    Channel& layer = plane_of(frame, layer_name("peel", int(k))).channels[0];
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        std::vector<float> depths;
        for (const Scene& scene : scenes) depths.push_back(depth_at(shot, scene, x, y));
        std::sort(depths.begin(), depths.end());
        layer.at(x, y) = depths[k];
      }
    }
  }
  return frame;
}

// --- Row 15

constexpr double radius = 0.8;
const glm::dvec3 ball_centre(0, -0.15, -3.6);
constexpr double ball_radius = 0.25;

Scene floor_and_wall() { return corner(); }
Scene nowhere() {
  return [](const EyeRay&) { return std::optional<Surface>(); };
}

/// Whether the technique knows the surfaces behind the depth: a stack of layers, none drawn at random.
bool sees_all_surfaces(const Plan& plan) {
  bool reads_layers = false;
  for (const PlannedPass& planned : plan.passes) {
    if (planned.values.has("alpha")) return false;
    for (const Binding& binding : planned.pass.reads) reads_layers |= plan.stacks.contains(binding.plane);
  }
  return reads_layers;
}

/// Pixels that show the same surface with and without the ball.
std::vector<char> shows_the_same(const Shot& shot) {
  const Scene ground = floor_and_wall(), occluder = ball(ball_centre, ball_radius);
  std::vector<char> same(size_t(shot.width * shot.height));
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      same[size_t(y * shot.width + x)] = !occluder(ray) && ground(ray);
    }
  }
  return same;
}

/// Those of these pixels for which the ball hides nothing within the radius.
std::vector<char> keeps_its_occluders(const Shot& shot) {
  const Scene ground = floor_and_wall(), occluder = ball(ball_centre, ball_radius);
  std::vector<glm::dvec3> hidden;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const auto behind = ground(ray);
      if (occluder(ray) && behind) hidden.push_back(point_at(ray, behind->depth));
    }
  }
  std::vector<char> keeps(size_t(shot.width * shot.height));
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const auto seen = ground(ray);
      if (occluder(ray) || !seen) continue;
      const glm::dvec3 point = point_at(ray, seen->depth);
      keeps[size_t(y * shot.width + x)] = std::all_of(hidden.begin(), hidden.end(), [&](const glm::dvec3& other) {
        return glm::length(other - point) > 1.05 * radius;
      });
    }
  }
  return keeps;
}

/// If all surfaces are known, every pixel that shows the same surface is compared; from depth alone, only those that lose no
/// occluder.
void occluder_more(Probe& probe) {
  if (!makes_ao(probe)) return;
  for (const Shot& shot : usual_shots()) {
    const Shot here = shot.camera.orthographic ? orthographic(80, 60, 4.5) : shot;
    const std::vector<char> all = shows_the_same(here), some = keeps_its_occluders(here);
    for (const RunOptions& way : probe.ways_of_rare_settings()) {
      if (!probe.tries(fmt::format("a ball before two walls, {}, {}", text_of(shot.camera), text_of(way)))) continue;
      Frame without = with_all_layers(here, {floor_and_wall(), nowhere()}),
            with = with_all_layers(here, {floor_and_wall(), ball(ball_centre, ball_radius)});
      const Settings settings = [&] {
        const Plan plan = plan_for(probe.technique(), without);
        return probe.usual_samples() + without_falloff(plan) +
               set_lengths(probe.technique(), without, [](double) { return radius; });
      }();
      const Plan plan = plan_for(probe.technique(), without, settings);
      plan_for(probe.technique(), with, settings);
      const std::vector<char>& keeps = sees_all_surfaces(plan) ? all : some;
      const std::string name = plane_of_ao(probe.technique());
      const Frame before = probe.outputs(plan, without, way), after = probe.outputs(plan, with, way);
      const Channel &a = before.views[0].find(name)->channels[0], &b = after.views[0].find(name)->channels[0];
      Measured most(0.0);
      double mean_shade = 0;
      for (int y = 0; y < here.height; ++y) {
        for (int x = 0; x < here.width; ++x) {
          if (!keeps[size_t(y * here.width + x)]) continue;
          const double more_open = double(b.at(x, y)) - a.at(x, y);
          mean_shade -= more_open;
          if (more_open > most.value)
            most = {more_open, Place{"", name, x, y, fmt::format("{} against {} without", b.at(x, y), a.at(x, y))}};
        }
      }
      probe.measure("more open with the ball than without", most, 1e-5);
      probe.measure("on the whole brighter with the ball than without: 1 where it is", mean_shade > 0 ? 0.0 : 1.0, 0);
    }
  }
}

// --- Row 16

struct Known {
  std::string name;
  Scene scene;
  double eye_width;  ///< scene units across for an orthographic eye
};

/// Surfaces and their rays in closed form.
const std::vector<Known>& known_scenes() {
  static const std::vector<Known> all = [] {
    const glm::vec3 grey(0.5f);
    analytic::Scene sphere, walls, canyon;
    sphere.add(analytic::make_box({-20, -3, -20}, {20, -1, 20}), grey);
    sphere.add(analytic::make_sphere({0, -0.4f, -4}, 0.5f), grey);
    walls.add(analytic::make_box({-20, -3, -20}, {20, -1, 20}), grey);
    walls.add(analytic::make_box({-20, -2, -20}, {20, 9, -4}), grey);
    // Below every ray's origin, also for an orthographic eye that looks down and sees the walls edge-on: their tops are near
    // enough.
    canyon.add(analytic::make_box({-20, -3, -20}, {20, -1.6f, 20}), grey);
    canyon.add(analytic::make_box({-20, -2, -20}, {-0.5f, -1.3f, 20}), grey);
    canyon.add(analytic::make_box({0.5f, -2, -20}, {20, -1.3f, 20}), grey);
    return std::vector<Known>{{"sphere over a plane", looking_down(solids(sphere), 0.4), 3},
                              {"walls at right angles", looking_down(solids(walls), 0.3), 3},
                              {"canyon", looking_down(solids(canyon), 0.5), 2}};
  }();
  return all;
}

/// Cosine-weighted share of the hemisphere in which nothing is nearer than the radius, from as many rays.
double open_share(const Scene& scene, const glm::dvec3& point, const glm::dvec3& normal, double reach, int rays) {
  const glm::dvec3 side =
      glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 other = glm::cross(normal, side);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const double u = (i + 0.5) / rays, turn = 2 * std::numbers::pi * std::fmod(i * 0.6180339887498949, 1.0);
    const double r = std::sqrt(u);
    const glm::dvec3 direction = r * std::cos(turn) * side + r * std::sin(turn) * other + std::sqrt(1 - u) * normal;
    const auto hit = scene({point + 1e-6 * normal, direction});
    open += !hit || hit->depth > reach;
  }
  return double(open) / rays;
}

constexpr int every = 4, rays_of_truth = 256;

/// AO without falloff at every fourth pixel of every fourth row; below 0 on background.
const std::vector<double>& truth_of(const Known& known, const Shot& shot) {
  static std::map<std::string, std::vector<double>> all;
  std::vector<double>& truth = all[known.name + text_of(shot.camera)];
  if (!truth.empty()) return truth;
  for (int y = 0; y < shot.height; y += every) {
    for (int x = 0; x < shot.width; x += every) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const auto seen = known.scene(ray);
      truth.push_back(seen ? open_share(known.scene, point_at(ray, seen->depth), seen->normal, 0.5, rays_of_truth)
                           : -1);
    }
  }
  return truth;
}

/// A model may differ from the truth, and the difference is stated; but an image no nearer to the truth than an all-white one is
/// not AO.
void surfaces_that_are_known(Probe& probe) {
  if (!makes_ao(probe)) return;
  for (const Known& known : known_scenes()) {
    for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, known.eye_width)}) {
      if (!probe.tries(fmt::format("{}, {}", known.name, text_of(shot.camera)))) continue;
      const std::vector<double>& truth = truth_of(known, shot);
      Frame frame = shoot(shot, known.scene);
      const Settings lengths = set_lengths(probe.technique(), frame, [](double) { return 0.5; });
      const Plan plan = plan_for(probe.technique(), frame, probe.usual_samples() + lengths);
      const Frame out = probe.outputs(plan, frame, {});
      const Channel& ao = filtered(out);
      double error = 0, of_white = 0, bias = 0, count = 0;
      size_t i = 0;
      for (int y = 0; y < shot.height; y += every) {
        for (int x = 0; x < shot.width; x += every) {
          const double exact = truth[i++], found = ao.at(x, y);
          if (exact < 0) continue;
          error += (found - exact) * (found - exact);
          of_white += (1 - exact) * (1 - exact);
          bias += found - exact;
          ++count;
        }
      }
      probe.measure(known.name + ": error to ray-traced AO, of that of an image all white", std::sqrt(error / of_white),
                    0.97);
      probe.measure(known.name + ": RMSE to ray-traced AO without falloff", std::sqrt(error / count), INFINITY);
      probe.measure(known.name + ": bias, towards either side", std::abs(bias / count), INFINITY);
    }
  }
}

// --- Row 17

/// Single pixels show the background behind the plane.
void one_pixel_holes(Probe& probe) {
  for (const Shot& shot : usual_shots()) {
    for (const RunOptions& way : probe.two_ways()) {
      if (!probe.tries(fmt::format("a plane with one-pixel holes, {}, {}", text_of(shot.camera), text_of(way))))
        continue;
      Frame frame = shoot(shot, tilted_plane(4, 0.4, 0.6));
      for (int y = 2; y < shot.height; y += 5) {
        for (int x = 3; x < shot.width; x += 7) {
          plane_of(frame, "depth").channels[0].at(x, y) = INFINITY;
          for (Channel& channel : plane_of(frame, "normal").channels) channel.at(x, y) = 0;
        }
      }
      const Plan plan = plan_for(probe.technique(), frame, probe.usual_samples());
      const Frame out = probe.outputs(plan, frame, way);
      probe.measure_violation("value out of its range beside one-pixel holes", out);
      if (!unit_interval_outputs(plan).empty() && probe.opt_out("open").empty())
        probe.measure("one-pixel holes: distance from open", distance_from_open(plan, out), 1e-6);
    }
  }
}

/// Upright wires as wide as a pixel before a wall, every eighth column. A wire should occlude little of the wall behind it: it
/// covers at most an eighth. An image with one depth layer turns wires into walls.
void wires(Probe& probe) {
  if (!makes_ao(probe)) return;
  constexpr double wall = 4, wire = 3.7, reach = 0.5;
  const Shot shot = orthographic(80, 60, 4);
  const double pixel = 4.0 / 80;
  analytic::Scene solid;
  const glm::vec3 grey(0.5f);
  solid.add(analytic::make_box({-20, -20, float(-wall - 1)}, {20, 20, float(-wall)}), grey);
  for (int column = 4; column < shot.width; column += 8) {
    const float left = float((column - 40) * pixel), right = float((column - 39) * pixel);
    solid.add(analytic::make_box({left, -20, float(-wire - pixel)}, {right, 20, float(-wire)}), grey);
  }
  const Scene scene = solids(solid);
  if (!probe.tries("wires of a pixel's width before a wall, orthographic")) return;
  Frame frame = shoot(shot, scene);
  const Settings lengths = set_lengths(probe.technique(), frame, [](double) { return reach; });
  const Plan plan = plan_for(probe.technique(), frame, probe.usual_samples() + lengths);
  const Frame out = probe.outputs(plan, frame, {});
  const Channel& ao = filtered(out);
  double over = 0, count = 0;
  for (int y = 10; y < 50; y += every) {
    for (int x = 10; x < 70; x += 3) {
      const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
      const auto seen = scene(ray);
      if (seen->depth < wall - 0.01) continue;
      over += open_share(scene, point_at(ray, seen->depth), seen->normal, reach, rays_of_truth) - ao.at(x, y);
      ++count;
    }
  }
  probe.measure("wires of a pixel's width: darker than ray-traced AO, mean", std::max(0.0, over / count), INFINITY);
  probe.measure("wires of a pixel's width: brighter than ray-traced AO, mean", std::max(0.0, -over / count), INFINITY);
}

/// A near and a far half, one of them closed and the other open: a filter must leave them so.
void filters_at_edges(Probe& probe) {
  const std::vector<std::string>& reads = probe.technique().reads;
  if (!holds(reads, "ao_raw")) return probe.passes_over("filters no ambient occlusion");
  if (!probe.opt_out("edges").empty()) return;
  for (const Shot& shot : usual_shots()) {
    for (const bool near_is_open : {true, false}) {
      for (const RunOptions& way : probe.two_ways()) {
        if (!probe.tries(fmt::format("a step in depth, the near side {}, {}, {}", near_is_open ? "open" : "closed",
                                     text_of(shot.camera), text_of(way))))
          continue;
        Frame frame = shoot(shot, [](const EyeRay& ray) {
          const bool is_near = (ray.origin + ray.direction).x > 0.01;
          return std::optional<Surface>(Surface{is_near ? 3.0 : 4.0, {0, 0, 1}});
        });
        Channel& raw = plane_of(frame, "ao_raw").channels[0];
        const Channel& depth = frame.views[0].find("depth")->channels[0];
        for (int y = 0; y < shot.height; ++y) {
          for (int x = 0; x < shot.width; ++x) raw.at(x, y) = (depth.at(x, y) < 3.5f) == near_is_open ? 1 : 0;
        }
        const Plan plan = plan_for(probe.technique(), frame);
        const Frame out = probe.outputs(plan, frame, way);
        Measured most(0.0);
        for (const View& view : out.views) {
          const Plane* ao = view.find("ao");
          for (int y = 0; ao && y < shot.height; ++y) {
            for (int x = 0; x < shot.width; ++x) {
              const double bled = std::abs(double(ao->channels[0].at(x, y)) - raw.at(x, y));
              if (bled > most.value)
                most = {bled, Place{view.name, "ao", x, y,
                                    fmt::format("{} against {}", ao->channels[0].at(x, y), raw.at(x, y))}};
            }
          }
        }
        probe.measure("filtered over a step in depth: bled", most, 1e-6);
      }
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> occluders() {
  return {
      {15,
       "one occluder more",
       "Without falloff, a ball added within the radius makes no pixel more open that still shows the same surface and "
       "loses no occluder behind the ball.",
       {occluder_more}},
      {16,
       "surfaces whose truth is known",
       "Over a sphere on a plane, walls at right angles and a canyon the distance from ray-traced AO without falloff "
       "is stated, and is less than that of an image all white. (The rays themselves against closed forms, and each "
       "estimator against its own integral: tests/analytic.)",
       {surfaces_that_are_known}},
      {17,
       "thinner than a pixel",
       "One-pixel holes leave a plane open; the excess occlusion by wires of a pixel's width is stated; filters do not "
       "bleed over steps in depth.",
       {one_pixel_holes, wires, filters_at_edges}}};
}

}  // namespace case_files
}  // namespace gloam::stress
