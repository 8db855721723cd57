#include "spectrum/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "unit/message_of.h"

namespace gloam::bench::spectrum_test {
namespace {

constexpr int width = 128, height = 96;

Channel even(float value) { return Channel(Layout(width, height), value); }

/// The spectrum of an error over a flat wall.
template <typename Error>
Spectrum spectrum_of(const Error& error) {
  Channel test = even(0.5f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) test.at(x, y) += float(error(x, y));
  }
  return spectrum_over_flat(test, even(0.5f), even(2));
}

TEST(Spectrum, PutsAWaveIntoItsBand) {
  const double pi = std::acos(-1.0), amplitude = 0.1;
  const Spectrum found = spectrum_of([&](int x, int) { return amplitude * std::cos(2 * pi * x / 5.33); });
  EXPECT_NEAR(found.rms[1], amplitude / std::sqrt(2.0), 0.005);
  for (const size_t band : {0u, 2u, 3u}) EXPECT_LT(found.rms[band], 0.01) << band;
}

TEST(Spectrum, TellsAPatternFromNoiseOfTheSameStrength) {
  Random random(3);
  const Spectrum noise = spectrum_of([&](int, int) { return random.uniform(-0.1, 0.1); });
  const Spectrum pattern =
      spectrum_of([&](int x, int y) { return (x + y) % 4 < 2 ? 0.05 : random.uniform(-0.07, -0.03); });
  EXPECT_LT(noise.peak, 4);
  EXPECT_GT(pattern.peak, 50);
  EXPECT_EQ(noise.windows, pattern.windows);
}

TEST(Spectrum, CountsFlatSurfacesAlone) {
  Channel slope = even(2), edge = even(2);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      slope.at(x, y) = 1 / (0.5f + 0.001f * float(x) - 0.0005f * float(y));  // a plane seen in perspective
      if (x >= 64) edge.at(x, y) = 3;
    }
  }
  EXPECT_EQ(spectrum_over_flat(even(1), even(1), slope).windows, 7 * 5);
  EXPECT_EQ(spectrum_over_flat(even(1), even(1), edge).windows, 6 * 5);
  Channel uneven = even(1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) uneven.at(x, y) = float(x) / width;
  }
  EXPECT_EQ(test::message_of([&] { spectrum_over_flat(even(1), uneven, even(2)); }),
            "no 32x32 pixels show a flat surface that is evenly lit");
}

}  // namespace
}  // namespace gloam::bench::spectrum_test
