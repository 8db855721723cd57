// Hard cases 5 and 6: background in every spelling, depth in every encoding.
#include <Imath/half.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "gloam/exr.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "normalise/depth.h"
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

/// The frame as written by a renderer that marks background by `value`.
Frame with_background(const Frame& frame, float value) {
  Frame copy = clone(frame);
  for (View& view : copy.views) {
    for (auto& [name, plane] : view.planes) {
      if (plane_kind(name).meaning != PlaneKind::view_depth) continue;
      Channel& depth = plane.channels[0];
      for (int y = 0; y < copy.height(); ++y) {
        for (int x = 0; x < copy.width(); ++x) depth.at(x, y) = is_background(depth.at(x, y)) ? value : depth.at(x, y);
      }
    }
  }
  return copy;
}

/// A wall at that depth, through a camera with that far plane.
double surfaces_lost(float depth, std::optional<double> far_plane) {
  Frame frame = shoot(perspective(8, 8), tilted_plane(depth, 0, 0));
  frame.views[0].camera->far = far_plane;
  normalise(frame, {});
  double lost = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) lost += frame.views[0].find("depth")->channels[0].at(x, y) != depth;
  }
  return lost;
}

/// A value that nearly spells background is none.
void surfaces_beside_a_spelling(Probe& probe) {
  const float before_far = 250 * (1 - 1e-6f);  // the far plane itself is known to two roundings of float
  const std::tuple<const char*, float, std::optional<double>> walls[] = {
      {"9.9e9", 9.9e9f, {}},
      {"65504 without a flag", 65504, {}},
      {"a millionth before the far plane", before_far, 250.0},
      {"1.1e-30", 1.1e-30f, {}}};
  for (const auto& [name, depth, far_plane] : walls) {
    if (!probe.tries(fmt::format("a wall at {}", name))) continue;
    probe.measure("pixels of a wall that are taken for background", surfaces_lost(depth, far_plane), 0);
  }
}

struct Spelling {
  const char* name;
  float value;
  std::optional<float> flag;  ///< --background
  std::optional<double> far;  ///< far plane of the camera
};

const Spelling spellings[] = {{"0", 0, {}, {}},
                              {"NaN", std::numeric_limits<float>::quiet_NaN(), {}, {}},
                              {"-inf", -infinity, {}, {}},
                              {"1e10", 1e10f, {}, {}},
                              {"1e11", 1e11f, {}, {}},
                              {"far plane", 250, {}, 250.0},
                              {"far plane that float rounds", float(100.1), {}, 100.1},
                              {"65504 by flag", 65504, 65504.0f, {}},
                              {"-1 by flag", -1, -1.0f, {}}};

Frame only_depths(const Frame& frame) {
  Frame copy = clone(frame);
  for (View& view : copy.views)
    std::erase_if(view.planes,
                  [](const auto& plane) { return plane_kind(plane.first).meaning != PlaneKind::view_depth; });
  return copy;
}

void background_in_every_spelling(Probe& probe) {
  for (const Shot& shot : usual_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      plan_for(probe.technique(), frame);  // adds a second view with the same spelling
      for (const RunOptions& way : probe.two_ways()) {
        Lazy<Frame> expected([&] { return probe.outputs(frame, probe.usual_samples(), way); });
        for (const Spelling& spelling : spellings) {
          if (!probe.tries(fmt::format("background {}, {}, {}, {}", spelling.name, text_of(shot.camera),
                                       normals_text(with_normals), text_of(way))))
            continue;
          Frame other = with_background(frame, spelling.value);
          for (View& view : other.views) view.camera->far = spelling.far;
          normalise(other, spelling.flag);
          if (way.lanes == 1)  // compares what the technique reads
            probe.measure_bits("difference to background as +inf, as loaded", only_depths(other), only_depths(frame));
          probe.measure_bits("difference to background as +inf", probe.outputs(other, probe.usual_samples(), way),
                             expected.get());
        }
      }
    }
  }
}

void beside_background_as_if_nothing_were_there(Probe& probe) {
  if (!probe.opt_out("open").empty()) return;
  Frame probing = shoot(perspective(8, 8), tilted_plane(1, 0, 0), false);
  if (unit_interval_outputs(plan_for(probe.technique(), probing)).empty())
    return probe.passes_over("makes no plane of 0..1");
  for (const bool with_normals : {true, false}) {
    for (const Shot& shot : {perspective(112, 80), orthographic(112, 80, 6)}) {
      for (const double tilt : {0.0, 0.9, 1.4}) {
        Frame frame = shoot(shot, within(tilted_plane(5, tilt, 0.6), 1.3, 0.9), with_normals);
        for (const char* length : {"0.5", "inf"}) {
          const Settings lengths = set_lengths(probe.technique(), frame, [&](double) { return std::stod(length); });
          const Plan plan = plan_for(probe.technique(), frame, probe.usual_samples() + lengths);
          for (const RunOptions& way : probe.two_ways()) {
            if (!probe.tries(fmt::format("lone rectangle tilted by {}, lengths {}, {}, {}, {}", tilt, length,
                                         text_of(shot.camera), normals_text(with_normals), text_of(way))))
              continue;
            probe.measure("lone rectangle: distance from open, " + normals_text(with_normals),
                          distance_from_open(plan, probe.outputs(plan, frame, way)), 1e-6);
          }
        }
      }
    }
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
  float (*encode)(double);
  double mean_bound;  ///< on the mean absolute difference of any output to that from float32; measured, plus a margin
};

const Encoding encodings[] = {
    {"reversed-Z float, infinite far", DepthConvention::reversed, [](double z) { return float(near / z); }, 2e-5},
    {"NDC float", DepthConvention::ndc, [](double z) { return float(ndc_of(z)); }, 5e-5},
    {"NDC 24 bit", DepthConvention::ndc, [](double z) { return float(quantised(ndc_of(z), 24)); }, 5e-5},
    {"linear 24 bit", DepthConvention::z,
     [](double z) { return float(quantised(z / highest_linear, 24) * highest_linear); }, 3e-5},
    {"linear 16 bit", DepthConvention::z,
     [](double z) { return float(quantised(z / highest_linear, 16) * highest_linear); }, 5e-3},
    {"half", DepthConvention::z, [](double z) { return float(Imath::half(float(z))); }, 2e-2}};

/// `shot` with every depth encoded, and decoded by the code that reads files.
Frame encoded(const Shot& shot, const Scene& scene, const Encoding& encoding, bool with_normals) {
  Frame frame = shoot(shot, scene, with_normals);
  Channel& depth = plane_of(frame, "depth").channels[0];
  const bool from_far = encoding.convention == DepthConvention::reversed;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto seen = scene(ray_through(shot, x + 0.5, y + 0.5));
      const float nothing = encoding.convention == DepthConvention::ndc ? 1.0f : from_far ? 0.0f : infinity;
      depth.at(x, y) = seen ? encoding.encode(seen->depth) : nothing;
    }
  }
  StatedDepth stated{.convention = encoding.convention, .near = near};
  if (encoding.convention == DepthConvention::ndc) stated.far = far;
  std::vector<std::string> assumed;
  to_view_depth(depth, nullptr, frame.window, shot.camera, stated, assumed);
  normalise(frame);
  return frame;
}

float largest_of(const Plane& plane) {
  float largest = 1;
  for (const Channel& channel : plane.channels) {
    for (int y = 0; y < channel.layout().height; ++y) {
      for (int x = 0; x < channel.layout().width; ++x) largest = std::max(largest, std::abs(channel.at(x, y)));
    }
  }
  return largest;
}

/// Mean difference of the plane that differs most. For planes of any values, such as colors and counts, relative to the largest
/// value if that exceeds 1.
double mean_of_difference(const Frame& out, const Frame& expected) {
  double most = 0;
  for (size_t i = 0; i < expected.views.size(); ++i) {
    for (const auto& [name, plane] : expected.views[i].planes) {
      const bool has_any_value = plane_kind(name).meaning == PlaneKind::value;
      const double mean = difference(*out.views.at(i).find(name), plane).mean;
      most = std::max(most, mean / (has_any_value ? largest_of(plane) : 1));
    }
  }
  return most;
}

// The bounds are for normals made from depth, which suffer most: a step of the encoding over the width of a pixel (1/125 of the
// depth here), 0.007 for half, 0.02 for 16 bits of 20 units at depth 2; a mean lies well below. Planes of 0..1, AO and its
// filters, are held to a fifth of that. Slices follow the normal: with normals from depth the last bit of a depth may move a
// sample to the next pixel, so single pixels have no bound there.
void depth_encodings(Probe& probe) {
  const Shot shot = fine_shot();
  const RunOptions way{.math = Math::precise};
  for (const bool with_normals : {true, false}) {
    if (!with_normals && !probe.opt_out("normals from depth").empty()) continue;
    Frame exact = shoot(shot, room(), with_normals);
    const bool is_share = !unit_interval_outputs(plan_for(probe.technique(), exact)).empty();
    const Settings samples = probe.usual_samples();
    Lazy<Frame> expected([&] { return probe.outputs(exact, samples, way); });
    for (const Encoding& encoding : encodings) {
      const std::string what = fmt::format("{}, {}", encoding.name, normals_text(with_normals));
      if (!probe.tries(what)) continue;
      Frame frame = encoded(shot, room(), encoding, with_normals);
      const Frame out = probe.outputs(frame, samples, way);
      probe.measure_violation("value out of its range", out);
      if (!probe.opt_out("difference").empty()) continue;
      const Difference d = difference(out, expected.get());
      probe.measure(what + ": mean difference to float32", {mean_of_difference(out, expected.get()), d.place},
                    (is_share ? 0.2 : 1) * encoding.mean_bound);
      probe.measure(what + ": largest difference to float32", d,
                    encoding.convention == DepthConvention::reversed && with_normals ? 1e-4 : INFINITY);
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> depths() {
  return {{5,
           "background in every spelling",
           "Background as +inf, -inf, 0, NaN, 1e10, 1e11, the far plane or what --background says is recognised when a "
           "frame is loaded, and gives the same bits; surfaces beside it are as open as if nothing were there.",
           {background_in_every_spelling, surfaces_beside_a_spelling, beside_background_as_if_nothing_were_there}},
          {6,
           "depth in every encoding",
           "Depth as half, as 16 and 24 bit integers, as NDC and as reversed Z with an infinite far plane changes the "
           "image by no more than the encoding's own steps; reversed Z by 1e-4 at most where the frame has normals.",
           {depth_encodings}}};
}

}  // namespace case_files
}  // namespace gloam::stress
