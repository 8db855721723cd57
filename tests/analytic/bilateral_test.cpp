// The cross-bilateral filter where its result is known.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "gloam/normalise.h"
#include "gloam/run.h"
#include "support/estimate.h"
#include "support/stress.h"
#include "support/techniques.h"
#include "technique/ambient_occlusion.h"

namespace gloam::test::bilateral_test {
namespace {

Channel filtered(Frame& frame, const Settings& settings = {}) {
  const Frame out = outputs_of(find_technique("bilateral"), frame, settings, {.math = Math::precise});
  return out.views[0].find("ao")->channels[0].clone();
}

void set_raw(Frame& frame, const std::function<float(int, int)>& value) {
  Channel& raw = plane_of(frame, "ao_raw").channels[0];
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) raw.at(x, y) = value(x, y);
  }
  normalise(frame);
}

std::function<float(int, int)> noise(uint32_t seed) {
  return [random = std::mt19937(seed)](int, int) mutable { return float(random() >> 8) * 0x1p-24f; };
}

const char* const forms[] = {"separable", "square"};

class BilateralForm : public testing::TestWithParam<const char*> {
 protected:
  Settings settings(const Settings& more = {}) const {
    Settings all = {{"form", GetParam()}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(All, BilateralForm, testing::ValuesIn(forms));

TEST_P(BilateralForm, ConstantStaysConstant) {
  Frame frame = shoot(perspective(90, 70), room());
  set_raw(frame, [](int, int) { return 0.37f; });
  const Channel out = filtered(frame, settings());
  double worst = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      if (!is_background(plane_of(frame, "depth").channels[0].at(x, y)))
        worst = std::max(worst, std::abs(double(out.at(x, y)) - 0.37f));
    }
  }
  std::printf("bilateral, constant image: largest change %.2g\n", worst);
  EXPECT_LE(worst, 1e-6);
}

TEST_P(BilateralForm, DoesNotBleedOverADepthEdge) {
  for (const Shot& shot : {perspective(80, 60), orthographic(80, 60, 3)}) {
    const Scene steps = [](const EyeRay& ray) -> std::optional<Surface> {
      const bool near = ray.origin.x + ray.direction.x < 0.01;
      return Surface{near ? 2.0 : 2.2, {0, 0, 1}};
    };
    Frame frame = shoot(shot, steps);
    set_raw(frame, [&](int x, int y) { return plane_of(frame, "depth").channels[0].at(x, y) < 2.1f ? 0.2f : 0.9f; });
    const Channel out = filtered(frame, settings());
    double worst = 0;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x)
        worst = std::max(worst, std::abs(double(out.at(x, y)) - plane_of(frame, "ao_raw").channels[0].at(x, y)));
    }
    std::printf("bilateral, step of 0.7 on an edge of 2 depth tolerances, %s: largest change %.2g\n",
                shot.camera.orthographic ? "orthographic" : "perspective", worst);
    EXPECT_LE(worst, 1e-6);
  }
}

/// The point that a pixel shows, view space.
glm::dvec3 point_at(const Frame& frame, int x, int y) {
  const EyeRay ray = ray_through({*frame.views[0].camera, frame.width(), frame.height()}, x + 0.5, y + 0.5);
  return test::point_at(ray, value_at(frame, "depth", x, y));
}

glm::dvec3 normal_at(const Frame& frame, int x, int y) { return vector_at(frame, "normal", x, y); }

struct Tolerances {
  double distance, angle;
};

/// The sum over the square of taps that defines the filter.
double expected(const Frame& frame, int half_width, const Tolerances& tolerances, int x, int y) {
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  const Channel& raw = frame.views[0].find("ao_raw")->channels[0];
  const glm::dvec3 point = point_at(frame, x, y), normal = normal_at(frame, x, y);
  const auto window = [&](int k) { return std::pow(1 - std::pow(double(k) / (half_width + 1), 2), 2); };
  double sum = raw.at(x, y), weights = 1;
  for (int j = -half_width; j <= half_width; ++j) {
    for (int i = -half_width; i <= half_width; ++i) {
      const int column = x + i, row = y + j;
      if (column < 0 || column >= frame.width() || row < 0 || row >= frame.height() || (i == 0 && j == 0)) continue;
      if (is_background(depth.at(column, row))) continue;
      const double distance = std::abs(glm::dot(normal, point_at(frame, column, row) - point));
      const double apart = 1 - glm::dot(normal, normal_at(frame, column, row));
      const double weight = window(i) * window(j) * std::max(0.0, 1 - distance / tolerances.distance) *
                            std::max(0.0, 1 - apart / (1 - std::cos(tolerances.angle)));
      sum += weight * double(raw.at(column, row));
      weights += weight;
    }
  }
  return sum / weights;
}

// Rounding of depths near 3 (1e-7 of them) over a tolerance of 0.02 moves a weight by 1e-5, and their mean by less.
TEST(Bilateral, SquareIsTheSumThatDefinesIt) {
  const Tolerances all[] = {{0.02, 0.5}, {0.2, 1.2}, {1000, std::numbers::pi}};
  for (Shot shot : {perspective(90, 70), orthographic(90, 70, 4)}) {
    shot.camera.cx += 11.5;
    Frame frame = shoot(shot, room());
    set_raw(frame, noise(4));
    for (const Tolerances& tolerances : all) {
      const Channel out = filtered(frame, {{"form", "square"},
                                           {"half_width", "3"},
                                           {"radius", "1"},
                                           {"depth_tolerance", fmt::format("{}", tolerances.distance)},
                                           {"normal_tolerance", fmt::format("{:.9g}", tolerances.angle - 1e-7)}});
      double worst = 0;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          if (is_background(plane_of(frame, "depth").channels[0].at(x, y))) continue;
          worst = std::max(worst, std::abs(double(out.at(x, y)) - expected(frame, 3, tolerances, x, y)));
        }
      }
      std::printf("bilateral, square, %s, tolerances %g and %.3g: within %.2g of the sum in double\n",
                  shot.camera.orthographic ? "orthographic" : "perspective", tolerances.distance, tolerances.angle,
                  worst);
      EXPECT_LE(worst, 2e-6);
    }
  }
}

TEST(Bilateral, SeparableIsTheSquareOnAPlane) {
  Frame frame = shoot(perspective(90, 70), tilted_plane(2, 0.8, 0.5));
  set_raw(frame, noise(6));
  const Channel a = filtered(frame, {{"form", "separable"}}), b = filtered(frame, {{"form", "square"}});
  double worst = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) worst = std::max(worst, std::abs(double(a.at(x, y)) - b.at(x, y)));
  }
  std::printf("bilateral, separable against square on a tilted plane: %.2g\n", worst);
  EXPECT_LE(worst, 2e-6);
}

double variance(const Channel& channel, int border) {
  double sum = 0, squares = 0, count = 0;
  for (int y = border; y < channel.layout().height - border; ++y) {
    for (int x = border; x < channel.layout().width - border; ++x) {
      sum += channel.at(x, y);
      squares += double(channel.at(x, y)) * double(channel.at(x, y));
      ++count;
    }
  }
  return squares / count - sum / count * sum / count;
}

TEST(Bilateral, ReducesNoiseAsItsWindowSays) {
  for (const int half_width : {2, 4, 8}) {
    double sum = 0, squares = 0;
    for (int k = -half_width; k <= half_width; ++k) {
      const double t = double(k) / (half_width + 1), window = (1 - t * t) * (1 - t * t);
      sum += window;
      squares += window * window;
    }
    const double predicted = std::pow(squares / (sum * sum), 2);  // once across, once down
    Frame frame = shoot(perspective(400, 400), tilted_plane(2, 0, 0));
    double before = 0, after = 0;
    constexpr int images = 5;
    for (uint32_t seed = 1; seed <= images; ++seed) {
      set_raw(frame, noise(seed));
      const Channel out = filtered(frame, {{"half_width", fmt::format("{}", half_width)}});
      before += variance(plane_of(frame, "ao_raw").channels[0], half_width);
      after += variance(out, half_width);
    }
    std::printf("bilateral, half width %d: variance of noise times %.5f, the window says %.5f\n", half_width,
                after / before, predicted);
    // An image has 160000 pixels, of which one in 1/predicted is independent: the standard error of a variance is sqrt(2/n).
    EXPECT_NEAR(after / before / predicted, 1, 3 * std::sqrt(2 / (images * 160000 * predicted)));
  }
}

Frame transposed(const Frame& frame) {
  Frame other = blank(perspective(frame.height(), frame.width()));
  Camera& camera = *other.views[0].camera;
  camera.fx = camera.fy = frame.views[0].camera->fx;
  for (const auto& [name, plane] : frame.views[0].planes) {
    Plane& to = plane_of(other, name);
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      // Rows become columns: x and -y of a normal are exchanged.
      const size_t from = name == "normal" && i < 2 ? 1 - i : i;
      const float sign = name == "normal" && i < 2 ? -1.0f : 1.0f;
      for (int y = 0; y < other.height(); ++y) {
        for (int x = 0; x < other.width(); ++x) to.channels[i].at(x, y) = sign * plane.channels[from].at(y, x);
      }
    }
  }
  normalise(other);
  return other;
}

double asymmetry(const Scene& scene) {
  Frame frame = shoot(perspective(90, 70), scene);
  set_raw(frame, noise(3));
  Frame turned = transposed(frame);
  const Channel a = filtered(frame), b = filtered(turned);
  double worst = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) worst = std::max(worst, std::abs(double(a.at(x, y)) - b.at(y, x)));
  }
  return worst;
}

TEST(Bilateral, RowsAndColumnsAlike) {
  const double plane = asymmetry(tilted_plane(2, 0.8, 0.5)), edges = asymmetry(room());
  std::printf("bilateral, rows against columns: %.2g on a plane, %.2g where edges make it inseparable\n", plane, edges);
  EXPECT_LE(plane, 1e-6);
}

/// A work-item that goes down the rows keeps what a pass of its own would have written: the same bits, however many rows are left over.
TEST(BilateralSeparable, OnePassComputesWhatTwoPassesDo) {
  for (const int height : {1, 3, 31, 32, 33, 70}) {
    for (const char* half_width : {"1", "2", "4"}) {
      Frame frame = shoot(perspective(50, height), room());
      set_raw(frame, noise(7));
      const Plan one = plan_for(find_technique("bilateral"), frame, {{"half_width", half_width}});
      ASSERT_EQ(one.passes.size(), 1u);
      Plan two = one;
      two.passes.clear();
      for (Pass& pass : bilateral_passes_along_axes(std::stoi(half_width), "ao_raw", "ao")) {
        two.passes.push_back(one.passes.front());
        two.passes.back().pass = std::move(pass);
      }
      for (const int lanes : {1, 4, 16}) {
        const RunOptions options{.math = Math::precise, .lanes = lanes};
        EXPECT_TRUE(same_bits(run(one, frame, device(), options).frame, run(two, frame, device(), options).frame))
            << height << " rows, half width " << half_width << ", " << lanes << " lanes";
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test::bilateral_test
