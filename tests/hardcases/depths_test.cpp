// Hard cases 5 and 6: background in every spelling, depth in every encoding.
#include <Imath/half.h>

#include <cmath>
#include <limits>

#include "conventions.h"
#include "gloam/exr.h"
#include "gloam/planes.h"
#include "hard_case.h"

namespace gloam::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

/// The frame as a renderer would have written it that marks background by `value`.
Frame with_background(const Frame& frame, float value) {
  Frame copy = clone(frame);
  Channel& depth = plane_of(copy, "depth").channels[0];
  for (int y = 0; y < copy.height(); ++y) {
    for (int x = 0; x < copy.width(); ++x) depth.at(x, y) = is_background(depth.at(x, y)) ? value : depth.at(x, y);
  }
  return copy;
}

struct Spelling {
  const char* name;
  float value;
  std::optional<float> flag;  ///< --background
  std::optional<double> far;  ///< of the camera
};

TEST_P(HardCase, Row05BackgroundInEverySpelling) {
  SKIP_WHERE_OPTED_OUT(5);
  const Spelling spellings[] = {{"0", 0, {}, {}},
                                {"NaN", std::numeric_limits<float>::quiet_NaN(), {}, {}},
                                {"-inf", -inf, {}, {}},
                                {"1e10", 1e10f, {}, {}},
                                {"1e11", 1e11f, {}, {}},
                                {"far plane", 250, {}, 250.0},
                                {"far plane that float rounds", float(100.1), {}, 100.1},
                                {"65504 by flag", 65504, 65504.0f, {}},
                                {"-1 by flag", -1, -1.0f, {}}};
  int changed = 0, tried = 0;
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      for (const int lanes : usual_lanes(device())) {
        const Frame expected = outputs_of(technique(), frame, {}, {.lanes = lanes});
        for (const Spelling& spelling : spellings) {
          Frame other = with_background(frame, spelling.value);
          other.views[0].camera->far = spelling.far;
          normalise(other, spelling.flag);
          const bool same = same_bits(outputs_of(technique(), other, {}, {.lanes = lanes}), expected);
          EXPECT_TRUE(same) << spelling.name << ", lanes " << lanes;
          changed += !same;
          ++tried;
        }
      }
    }
  }
  report(5, fmt::format("share of {} images with other bits than with +inf", tried), double(changed) / tried, 0);
}

TEST_P(HardCase, Row05BesideBackgroundAsIfNothingWereThere) {
  SKIP_WHERE_OPTED_OUT(5);
  Frame probe = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (unit_interval_outputs(plan_for(technique(), probe)).empty()) GTEST_SKIP() << "makes no plane of 0..1";
  for (const bool with_normals : {true, false}) {
    double worst = 0;
    for (const Shot& shot : {perspective(112, 80), orthographic(112, 80, 6)}) {
      for (const double tilt : {0.0, 0.9, 1.4}) {
        Frame frame = shoot(shot, within(tilted_plane(5, tilt, 0.6), 1.3, 0.9), with_normals);
        for (const char* length : {"0.5", "inf"}) {
          const Settings lengths = set_lengths(technique(), frame, [&](double) { return std::stod(length); });
          const Plan plan = plan_for(technique(), frame, lengths);
          for (const int lanes : usual_lanes(device())) {
            worst = std::max(worst, worst_distance_from_open(plan, run(plan, frame, device(), {.lanes = lanes}).frame));
          }
        }
      }
    }
    report(
        5,
        std::string("lone rectangle, distance from open, ") + (with_normals ? "exact normals" : "normals from depth"),
        worst, 1e-6);
  }
}

// --- Row 6

constexpr double near = 0.1, far = 100, highest_linear = 20;

double quantised(double value, int bits) {
  return std::round(value * double((1 << bits) - 1)) / double((1 << bits) - 1);
}
double ndc_of(double z) { return far * (z - near) / (z * (far - near)); }

struct Encoding {
  const char* name;
  DepthConvention convention;
  std::function<float(double)> encode;
  double
      mean_bound;  ///< of the mean absolute difference of any output to that from float32; as measured, with a margin
};

/// `shot`, with every depth encoded, and brought back by the code that reads files.
Frame encoded(const Shot& shot, const Scene& scene, const Encoding& encoding, bool with_normals) {
  Frame frame = shoot(shot, scene, with_normals);
  Channel& depth = plane_of(frame, "depth").channels[0];
  const bool from_far = encoding.convention == DepthConvention::reversed;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
      const float nothing = encoding.convention == DepthConvention::ndc ? 1.0f : from_far ? 0.0f : inf;
      depth.at(x, y) = seen ? encoding.encode(seen->depth) : nothing;
    }
  }
  ReadOptions options;
  options.depth = encoding.convention;
  options.near = near;
  if (encoding.convention == DepthConvention::ndc) options.far = far;
  std::vector<std::string> assumed;
  to_view_depth(depth, nullptr, frame.window, shot.camera, options, assumed);
  normalise(frame);
  return frame;
}

bool makes_unit_interval(const Technique& technique, Frame& frame) {
  return !unit_interval_outputs(plan_for(technique, frame)).empty();
}

// The bounds are those of normals made from depth, which suffer most: a step of the encoding over the width of a pixel
// (1/139 of the depth here), 0.007 for half, 0.02 for 16 bits of 20 units at depth 2; a mean lies well below. Planes of
// 0..1, AO and its filters, are held to a fifth of that.
TEST_P(HardCase, Row06DepthEncodings) {
  SKIP_WHERE_OPTED_OUT(6);
  const Encoding encodings[] = {
      {"reversed-Z float, infinite far", DepthConvention::reversed, [](double z) { return float(near / z); }, 1e-5},
      {"NDC float", DepthConvention::ndc, [](double z) { return float(ndc_of(z)); }, 5e-5},
      {"NDC 24 bit", DepthConvention::ndc, [](double z) { return float(quantised(ndc_of(z), 24)); }, 5e-5},
      {"linear 24 bit", DepthConvention::z,
       [](double z) { return float(quantised(z / highest_linear, 24) * highest_linear); }, 3e-5},
      {"linear 16 bit", DepthConvention::z,
       [](double z) { return float(quantised(z / highest_linear, 16) * highest_linear); }, 5e-3},
      {"half", DepthConvention::z, [](double z) { return float(Imath::half(float(z))); }, 2e-2}};
  const Shot shot = perspective(160, 120);
  for (const bool with_normals : {true, false}) {
    if (!with_normals && !opt_out(technique(), 6, "normals from depth").empty()) continue;
    Frame exact = shoot(shot, room(), with_normals);
    const Frame expected = outputs_of(technique(), exact, {}, {.math = Math::precise});
    for (const Encoding& encoding : encodings) {
      Frame frame = encoded(shot, room(), encoding, with_normals);
      const Frame out = outputs_of(technique(), frame, {}, {.math = Math::precise});
      EXPECT_EQ(violation(out), "") << encoding.name;
      const Difference d = difference(out, expected);
      const double share = makes_unit_interval(technique(), frame) ? 0.2 : 1;
      if (encoding.convention == DepthConvention::reversed)
        report(6, "reversed-Z: largest difference to float32", d.max, 1e-4);
      report(6,
             fmt::format("{}, {}: mean difference to float32, largest {:.2g}", encoding.name,
                         with_normals ? "exact normals" : "normals from depth", d.max),
             d.mean, share * encoding.mean_bound);
    }
  }
}

}  // namespace
}  // namespace gloam::test
