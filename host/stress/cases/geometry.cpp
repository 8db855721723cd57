// Hard cases 2, 3 and 8: planes at any tilt and depth, the unit of the scene, radii of any size.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/frames.h"
#include "stress/surfaces.h"

namespace gloam::stress {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A shot of the whole part of the plane in front of the eye, whatever its tilt: at a cut edge the last pixel may have no
/// neighbour to the left or right that tells the tilt.
Shot shot_of_plane(bool is_orthographic, double depth, double tilt) {
  if (!is_orthographic) return perspective(112, 80);
  return orthographic(112, 80, depth / std::max(1.0, std::tan(tilt)));
}

/// Trials over tilts, turns, depths and lane widths, all measured under one name.
void planes_read_open(Probe& probe, bool is_orthographic, bool with_normals, const Settings& settings,
                      const std::string& what, double bound) {
  const Technique& technique = probe.technique();
  const bool few_depths = !settings.empty() || probe.is_quick(), few_turns = !settings.empty() && probe.is_quick();
  for (const double depth : few_depths ? std::vector{1.0, 1e6} : std::vector{1e-3, 1.0, 1e3, 1e6}) {
    for (const double tilt : {0.0, 35.0, 60.0, 80.0, 89.0, 89.9}) {
      for (const double turn : few_turns ? std::vector{40.0} : std::vector{0.0, 40.0, 90.0}) {
        const Shot shot = shot_of_plane(is_orthographic, depth, tilt * degree);
        Lazy<Frame> frame([&] { return shoot(shot, tilted_plane(depth, tilt * degree, turn * degree), with_normals); });
        for (const RunOptions& way : probe.two_ways()) {
          if (!probe.tries(fmt::format("{}, depth {}, tilt {}, turn {}, {}, {}", text_of(shot.camera), depth, tilt,
                                       turn, text_of(settings), text_of(way))))
            continue;
          Frame copy = clone(frame.get());
          const Settings all =
              probe.usual_samples() + set_lengths(technique, copy, [&](double) { return 0.1 * depth; }) + settings;
          const Plan plan = plan_for(technique, copy, all);
          probe.measure(what, distance_from_open(plan, probe.outputs(plan, copy, way)), bound);
        }
      }
    }
  }
}

/// Each tolerance, threshold and factor at its least, one at a time: defaults may hide an error.
std::vector<Settings> least_values(const Technique& technique, Frame& frame) {
  std::vector<Settings> all;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      const Settings least = {{planned.technique->name + "." + p.name, fmt::format("{}", p.min)}};
      const bool is_known = std::find(all.begin(), all.end(), least) != all.end();
      if (p.type == Parameter::Type::floating && p.unit != "scene units" && !is_known) all.push_back(least);
    }
  }
  return all;
}

bool makes_unit_interval(Probe& probe, Frame& frame) {
  if (!unit_interval_outputs(plan_for(probe.technique(), frame)).empty()) return true;
  probe.passes_over("makes no plane of 0..1");
  return false;
}

// Without a bias only rounding is left: of positions relative to the pixel's depth (6e-8) over the distance of the nearest sample
// (a pixel, 1/97 of the depth), a few 1e-6, more if a plane is seen edge-on.
void tilted_plane_without_tolerances(Probe& probe) {
  Frame frame = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (!makes_unit_interval(probe, frame)) return;
  for (const Settings& settings : least_values(probe.technique(), frame))
    planes_read_open(probe, false, true, settings, "distance from open, each tolerance at its least", 2e-5);
}

void tilted_plane_reads_open(Probe& probe) {
  Frame frame = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (!makes_unit_interval(probe, frame)) return;
  for (const bool is_orthographic : {false, true}) {
    planes_read_open(probe, is_orthographic, true, {}, "distance from open, exact normals", 1e-6);
    planes_read_open(probe, is_orthographic, false, {}, "distance from open, normals from depth", 1e-6);
  }
}

// --- Row 3

/// Scales back depths and positions among the outputs, which grow with the scene; everything else stays.
Frame unscaled(const Frame& frame, int k) { return in_other_unit(frame, -k); }

void unit_of_the_scene(Probe& probe) {
  const Technique& technique = probe.technique();
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      plan_for(technique, frame);  // adds invented planes before scaling
      for (const RunOptions& way : probe.all_ways()) {
        Lazy<Frame> expected([&] { return probe.outputs(frame, probe.usual_samples(), way); });
        for (int k = -20; k <= 20; k += probe.is_quick() ? 8 : 1) {
          if (!probe.tries(
                  fmt::format("2^{}, {}, {}, {}", k, text_of(shot.camera), normals_text(with_normals), text_of(way))))
            continue;
          Frame bigger = in_other_unit(frame, k);
          const Settings lengths = set_lengths(technique, bigger, [&](double length) { return std::ldexp(length, k); });
          probe.measure_bits("difference to the scene with another unit",
                             unscaled(probe.outputs(bigger, probe.usual_samples() + lengths, way), k), expected.get());
        }
      }
    }
  }
}

// --- Row 8

void radius_zero_is_open(Probe& probe) {
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      const Settings zero = set_lengths(probe.technique(), frame, [](double) { return 0.0; });
      const std::vector<Settings> settings =
          probe.is_quick() ? std::vector<Settings>{few_samples(probe.technique())} : variants(probe.technique(), frame);
      for (const Settings& variant : settings) {
        for (const RunOptions& way : probe.two_ways()) {
          if (!probe.tries(fmt::format("lengths 0, {}, {}, {}, {}", text_of(variant), text_of(shot.camera),
                                       normals_text(with_normals), text_of(way))))
            continue;
          const Plan plan = plan_for(probe.technique(), frame, variant + zero);
          const Frame out = probe.outputs(plan, frame, way);
          probe.measure_violation("value out of its range at radius 0", out);
          if (!zero.empty() && !unit_interval_outputs(plan).empty() && probe.opt_out("open").empty())
            probe.measure("distance from open at radius 0", distance_from_open(plan, out), 0);
        }
      }
    }
  }
}

void radius_of_any_size_is_defined(Probe& probe) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, 4), orthographic(80, 60, 1e-5)}) {
    for (const Scene& scene : {room(), near_and_far()}) {
      for (const bool with_normals : {true, false}) {
        Frame frame = shoot(shot, scene, with_normals);
        for (const double length : {1e-30, 1e-6, 0.01, 100.0, 1e8, 1e30, infinity}) {
          for (const RunOptions& way : probe.all_ways()) {
            if (!probe.tries(fmt::format("lengths {}, {}, {}, {}", length, text_of(shot.camera),
                                         normals_text(with_normals), text_of(way))))
              continue;
            const Settings lengths = set_lengths(probe.technique(), frame, [&](double) { return length; });
            probe.measure_violation("value out of its range at radii under a pixel to infinite",
                                    probe.outputs(frame, probe.usual_samples() + lengths, way));
          }
        }
      }
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> geometry() {
  return {
      {2,
       "tilted planes",
       "A plane, tilted by 0 to 89.9 degrees, at depths of 1e-3 to 1e6 and with a radius of a tenth of the depth, "
       "reads open: nothing shadows itself.",
       {tilted_plane_reads_open, tilted_plane_without_tolerances}},
      {3,
       "unit of the scene",
       "Scaling the scene and its lengths by 2^-20 to 2^20 gives the same bits: there is no hidden absolute epsilon.",
       {unit_of_the_scene}},
      {8,
       "radius of any size",
       "A radius of 0 reads open; one under a pixel, larger than the screen or infinite gives values in their "
       "range, and ends.",
       {radius_zero_is_open, radius_of_any_size_is_defined}}};
}

}  // namespace case_files
}  // namespace gloam::stress
