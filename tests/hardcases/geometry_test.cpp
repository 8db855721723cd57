// Hard cases 2, 3 and 8: planes at any tilt and depth, the unit of the scene, radii of any size.
#include <cmath>
#include <limits>
#include <numbers>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "hard_case.h"

namespace gloam::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::string camera_name(const Shot& shot) { return shot.camera.orthographic ? "orthographic" : "perspective"; }

/// Of all of the plane in front of the eye, whatever its tilt: where a plane is cut off, its last pixel may have no
/// neighbour left or right and none tells how it is tilted that way.
Shot shot_of_plane(bool is_orthographic, double depth, double tilt) {
  if (!is_orthographic) return perspective(112, 80);
  return orthographic(112, 80, depth / std::max(1.0, std::tan(tilt)));
}

/// Worst distance from open over tilts, turns, depths and lane widths; `where` says at which.
double worst_on_planes(const Technique& technique, bool is_orthographic, bool with_normals, const Settings& settings,
                       std::string& where) {
  double worst = -1;
  for (const double depth : settings.empty() ? std::vector{1e-3, 1.0, 1e3, 1e6} : std::vector{1.0, 1e6}) {
    for (const double tilt : {0.0, 35.0, 60.0, 80.0, 89.0, 89.9}) {
      for (const double turn : {0.0, 40.0, 90.0}) {
        const Shot shot = shot_of_plane(is_orthographic, depth, tilt * degree);
        Frame frame = shoot(shot, tilted_plane(depth, tilt * degree, turn * degree), with_normals);
        const Plan plan =
            plan_for(technique, frame, set_lengths(technique, frame, [&](double) { return 0.1 * depth; }) + settings);
        for (const int lanes : usual_lanes(device())) {
          const Frame out = run(plan, frame, device(), {.lanes = lanes}).frame;
          const double here = worst_distance_from_open(plan, out);
          if (here > worst) where = fmt::format("depth {}, tilt {}, turn {}, lanes {}", depth, tilt, turn, lanes);
          worst = std::max(worst, here);
        }
      }
    }
  }
  return worst;
}

/// Each tolerance, threshold and factor at its least, by itself: defaults may hide what they are there to hide.
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

// Without a bias, what is left is rounding: of positions relative to the pixel's depth (6e-8) over the distance of the
// nearest sample (a pixel, 1/97 of the depth), a few 1e-6, more where a plane is seen edge-on.
TEST_P(HardCase, Row02TiltedPlaneWithoutTolerances) {
  SKIP_WHERE_OPTED_OUT(2);
  Frame probe = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (unit_interval_outputs(plan_for(technique(), probe)).empty()) GTEST_SKIP() << "makes no plane of 0..1";
  for (const Settings& settings : least_values(technique(), probe)) {
    std::string where;
    const double worst = worst_on_planes(technique(), false, true, settings, where);
    report(2, fmt::format("tilted plane, {}; at {}", text_of(settings), where), worst, 2e-5);
  }
}

TEST_P(HardCase, Row02TiltedPlaneReadsOpen) {
  SKIP_WHERE_OPTED_OUT(2);
  Frame probe = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (unit_interval_outputs(plan_for(technique(), probe)).empty()) GTEST_SKIP() << "makes no plane of 0..1";
  for (const bool is_orthographic : {false, true}) {
    for (const bool with_normals : {true, false}) {
      std::string where;
      const double worst = worst_on_planes(technique(), is_orthographic, with_normals, {}, where);
      report(2,
             fmt::format("tilted plane, {}, {}; at {}", is_orthographic ? "orthographic" : "perspective",
                         with_normals ? "exact normals" : "normals from depth", where),
             worst, 1e-6);
    }
  }
}

/// The same view of the same scene with another unit of length.
Frame scaled(const Frame& frame, int k) {
  Frame copy = clone(frame);
  for (View& view : copy.views) {
    if (view.camera->orthographic) {
      view.camera->fx = std::ldexp(view.camera->fx, -k);
      view.camera->fy = std::ldexp(view.camera->fy, -k);
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

/// Depths and positions among the outputs grow with the scene; everything else stays.
Frame unscaled(const Frame& frame, int k) { return scaled(frame, -k); }

TEST_P(HardCase, Row03UnitOfTheScene) {
  SKIP_WHERE_OPTED_OUT(3);
  int changed = 0, tried = 0;
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      plan_for(technique(), frame);  // adds what nothing makes, before it is scaled
      for (const RunOptions& way : all_ways()) {
        const Frame expected = outputs_of(technique(), frame, {}, way);
        for (int k = -20; k <= 20; k += 4) {
          Frame bigger = scaled(frame, k);
          const Settings lengths =
              set_lengths(technique(), bigger, [&](double length) { return std::ldexp(length, k); });
          const Frame out = unscaled(outputs_of(technique(), bigger, lengths, way), k);
          ++tried;
          if (same_bits(out, expected)) continue;
          if (++changed <= 5) {
            ADD_FAILURE() << "2^" << k << ", " << camera_name(shot) << ", lanes " << way.lanes
                          << (way.math == Math::fast ? ", fast" : ", precise") << ": differs by up to "
                          << difference(out, expected).max;
          }
        }
      }
    }
  }
  report(3, fmt::format("share of {} scaled images with other bits", tried), double(changed) / tried, 0);
}

TEST_P(HardCase, Row08RadiusZeroIsOpen) {
  SKIP_WHERE_OPTED_OUT(8);
  double worst = 0;
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      const Settings zero = set_lengths(technique(), frame, [](double) { return 0.0; });
      for (const Settings& variant : variants(technique(), frame)) {
        const Plan plan = plan_for(technique(), frame, variant + zero);
        for (const RunOptions& way : two_ways()) {
          const Frame out = run(plan, frame, device(), way).frame;
          EXPECT_EQ(violation(out), "") << text_of(variant);
          if (zero.empty()) continue;  // no parameter is a length
          worst = std::max(worst, worst_distance_from_open(plan, out));
        }
      }
    }
  }
  report(8, "distance from open at radius 0", worst, 0);
}

/// A hand's breadth before the eye beside a mountain, pixel by pixel and in halves.
Scene near_and_far() {
  return [](const EyeRay& ray) -> std::optional<Surface> {
    const glm::dvec3 side = ray.origin + ray.direction;
    const bool near = side.y > 0 ? side.x > 0 : (long(std::floor(side.x * 40)) & 1) != 0;
    return Surface{near ? 1e-6 : 1e6, {0, 0, 1}};
  };
}

TEST_P(HardCase, Row08RadiusOfAnySizeIsDefined) {
  SKIP_WHERE_OPTED_OUT(8);
  int tried = 0, wrong = 0;
  for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, 4), orthographic(80, 60, 1e-5)}) {
    for (const Scene& scene : {room(), near_and_far()}) {
      for (const bool with_normals : {true, false}) {
        Frame frame = shoot(shot, scene, with_normals);
        for (const double length : {1e-30, 1e-6, 0.01, 100.0, 1e8, 1e30, std::numeric_limits<double>::infinity()}) {
          const Settings lengths = set_lengths(technique(), frame, [&](double) { return length; });
          for (const int lanes : usual_lanes(device())) {
            for (const Math math : {Math::precise, Math::fast}) {
              ++tried;
              const std::string found =
                  violation(outputs_of(technique(), frame, lengths, {.math = math, .lanes = lanes}));
              wrong += !found.empty();
              EXPECT_EQ(found, "") << camera_name(shot) << ", length " << length << ", lanes " << lanes;
            }
          }
        }
      }
    }
  }
  report(8,
         fmt::format("share of {} images with a value out of its range: radius under a pixel to infinite, near eye",
                     tried),
         double(wrong) / tried, 0);
}

}  // namespace
}  // namespace gloam::test
