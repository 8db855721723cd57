// The Gaussian filter against the sum that defines it, in double.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gloam/normalise.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::gaussian_test {
namespace {

constexpr int width = 53, height = 41;

struct Filter {
  double sigma;
  int half_width;
  Settings settings() const {
    return {{"sigma", fmt::format("{}", sigma)}, {"half_width", fmt::format("{}", half_width)}};
  }
  /// Not normalised.
  double weight(int k) const { return std::exp(-0.5 * k * k / (sigma * sigma)); }
};

const Filter filters[] = {{0.4, 2}, {1.5, 4}, {3, 9}, {7, 20}};

using Image = std::function<float(int, int)>;

Channel filtered(Frame& frame, const Image& image, const Settings& settings,
                 const RunOptions& options = {.math = Math::precise}) {
  Channel& raw = plane_of(frame, "ao_raw").channels[0];
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) raw.at(x, y) = image(x, y);
  }
  normalise(frame);
  return outputs_of(find_technique("gaussian"), frame, settings, options).views[0].find("ao")->channels[0].clone();
}

Image noise() {
  return [random = std::mt19937(5)](int, int) mutable { return float(random() >> 8) * 0x1p-24f; };
}

/// A wall that fills the image.
Frame wall() { return shoot(perspective(width, height), tilted_plane(2, 0, 0)); }

/// The sum over the whole square of taps, of surfaces in the image only.
double expected(const Frame& frame, const Filter& filter, int x, int y) {
  const Channel& depth = frame.views[0].find("depth")->channels[0];
  const Channel& raw = frame.views[0].find("ao_raw")->channels[0];
  double sum = 0, weights = 0;
  for (int j = -filter.half_width; j <= filter.half_width; ++j) {
    for (int i = -filter.half_width; i <= filter.half_width; ++i) {
      if (x + i < 0 || x + i >= frame.width() || y + j < 0 || y + j >= frame.height()) continue;
      if (is_background(depth.at(x + i, y + j))) continue;
      const double weight = filter.weight(i) * filter.weight(j);
      sum += weight * double(raw.at(x + i, y + j));
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(Gaussian, ConstantStaysConstant) {
  for (const Filter& filter : filters) {
    Frame frame = shoot(perspective(90, 70), room());
    for (const Math math : {Math::precise, Math::fast}) {
      const Channel out = filtered(frame, [](int, int) { return 0.37f; }, filter.settings(), {.math = math});
      double worst = 0;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          if (!is_background(plane_of(frame, "depth").channels[0].at(x, y)))
            worst = std::max(worst, std::abs(double(out.at(x, y)) - 0.37f));
        }
      }
      EXPECT_LE(worst, 1e-6) << "sigma " << filter.sigma;
    }
  }
}

TEST(Gaussian, ImpulseGivesTheGaussian) {
  for (const Filter& filter : filters) {
    const int half_width = std::min(filter.half_width, 9);  // all of it within the image
    const Filter here{filter.sigma, half_width};
    Frame frame = wall();
    const Channel out = filtered(
        frame, [](int x, int y) { return x == width / 2 && y == height / 2 ? 1.0f : 0.0f; }, here.settings());
    double sum = 0, worst = 0, total = 0;
    for (int k = -half_width; k <= half_width; ++k) sum += here.weight(k);
    for (int y = 2 * half_width; y < height - 2 * half_width; ++y) {
      for (int x = 2 * half_width; x < width - 2 * half_width; ++x) {
        const int i = x - width / 2, j = y - height / 2;
        const bool reached = std::abs(i) <= half_width && std::abs(j) <= half_width;
        const double value = reached ? here.weight(i) * here.weight(j) / (sum * sum) : 0;
        worst = std::max(worst, std::abs(double(out.at(x, y)) - value));
        total += out.at(x, y);
      }
    }
    std::printf("gaussian, sigma %g, %d taps: impulse within %.2g\n", here.sigma, 2 * half_width + 1, worst);
    EXPECT_LE(worst, 1e-6);
    EXPECT_GT(total, 0) << "the impulse was not looked at";
  }
}

/// With a hole of background, and at the borders of the image, where the weights are normalised.
TEST(Gaussian, IsTheSumInTwoDimensionsEverywhere) {
  for (const Filter& filter : filters) {
    Frame frame = shoot(perspective(width, height), room());
    const Channel out = filtered(frame, noise(), filter.settings());
    const Channel& depth = plane_of(frame, "depth").channels[0];
    double worst = 0;
    int surfaces = 0, background = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (is_background(depth.at(x, y))) {
          ++background;
          continue;
        }
        ++surfaces;
        worst = std::max(worst, std::abs(double(out.at(x, y)) - expected(frame, filter, x, y)));
      }
    }
    std::printf("gaussian, sigma %g: within %.2g of the sum over the square\n", filter.sigma, worst);
    EXPECT_LE(worst, 1e-6);
    EXPECT_GT(surfaces, 100);
    EXPECT_GT(background, 100) << "the frame has no background to be left out";
  }
}

TEST(Gaussian, BackgroundNeitherGivesNorTakes) {
  Frame frame = shoot(perspective(width, height), room());
  const Channel& depth = plane_of(frame, "depth").channels[0];
  const auto image_with = [&](float behind) -> Image {
    return [&depth, behind](int x, int y) { return is_background(depth.at(x, y)) ? behind : 0.25f; };
  };
  for (const float behind : {0.0f, 1.0f}) {
    const Channel out = filtered(frame, image_with(behind), filters[2].settings());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (is_background(depth.at(x, y)))
          ASSERT_EQ(out.at(x, y), 1) << x << ", " << y;
        else
          ASSERT_NEAR(out.at(x, y), 0.25, 1e-6) << x << ", " << y << ", with " << behind << " behind";
      }
    }
  }
}

TEST(Gaussian, NothingIsFilteredWithoutWidth) {
  for (const Settings& settings : {Settings{{"sigma", "0"}}, Settings{{"half_width", "0"}}}) {
    Frame frame = wall();
    const Channel out = filtered(frame, noise(), settings);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x)
        ASSERT_EQ(out.at(x, y), plane_of(frame, "ao_raw").channels[0].at(x, y)) << x << ", " << y;
    }
  }
}

TEST(Gaussian, FollowsAnEstimateWhereItIsAskedFor) {
  const auto passes_with = [](const std::string& filter) {
    std::vector<std::string> labels;
    const std::vector<std::string> available = {"depth", "normal"};
    for (const PlannedPass& pass : make_plan({.outputs = {"hbao+"}, .filter = filter}, available, "").passes)
      labels.push_back(pass.label());
    return labels;
  };
  EXPECT_EQ(passes_with("gaussian"),
            (std::vector<std::string>{"hbao+/estimate", "gaussian/horizontal", "gaussian/vertical"}));
  const Plan by_plane = make_plan({.outputs = {"ao"}}, {"depth", "normal", "ao_raw"}, "");
  EXPECT_EQ(by_plane.technique, "bilateral") << "the filter that techniques name stays the default";
}

}  // namespace
}  // namespace gloam::test::gaussian_test
