// One slice a pixel against many: slices are drawn in proportion to their weight, so the mean over seeds is the integral over
// the hemisphere, however the surface is tilted.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/integral.h"

namespace gloam::test::one_slice_test {
namespace {

Settings slices(int directions) {
  return {{"radius", "0.8"}, {"directions", std::to_string(directions)}, {"steps", "32"}, {"bias", "0"}};
}

/// Pixels of the upper wall of a corner, near the line where the walls meet. The wall is turned away by so many degrees.
IntegralCase upper_wall(const std::string& camera, double degrees) {
  IntegralCase test = integral_case("corner, " + camera);
  test.name += fmt::format(", tilted by {} degrees", degrees);
  test.scene = corner(degrees * std::numbers::pi / 180);
  test.pixels.clear();
  // Within half a radius of the line, which covers less of the image the more the wall is tilted.
  const double half =
      0.4 * test.shot.camera.fx / (camera == "orthographic" ? 1 : 4) * std::cos(degrees * std::numbers::pi / 180);
  for (int i = 0; i < 8; ++i) test.pixels.push_back({200 + 5 * i, 179 - int(half * (i + 1) / 8)});
  return test;
}

/// The mean over pixels of the difference between the mean of one slice over many seeds and many slices. Prints both differences.
void expect_same_mean(const IntegralCase& test, const std::string& technique) {
  const std::vector<Estimate> all = estimates(test, technique, slices(64), 16);
  const std::vector<Estimate> one = estimates(test, technique, slices(1), 1024);
  double sum = 0, squares = 0, most_closed = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const double difference = one[i].mean - all[i].mean;
    sum += difference;
    squares += difference * difference;
    most_closed = std::max(most_closed, 1 - all[i].mean);
  }
  const double count = double(all.size());
  std::printf("%s, %s: mean difference %.5f, RMS %.5f, AO down to %.3f\n", technique.c_str(), test.name.c_str(),
              sum / count, std::sqrt(squares / count), 1 - most_closed);
  EXPECT_GT(most_closed, 0.1) << test.name << ": the case tests nothing";
  EXPECT_LT(std::abs(sum / count), 1e-3) << technique << ", " << test.name;
  // Sectors are whole: of 31, one more or less.
  EXPECT_LT(std::sqrt(squares / count), technique == "bitmask" ? 2e-3 : 1e-3) << technique << ", " << test.name;
}

TEST(OneSlice, IsTheIntegralOnAverageOverSeeds) {
  for (const double degrees : {45.0, 70.0, 85.0}) {
    for (const std::string camera : {"perspective", "orthographic"})
      expect_same_mean(upper_wall(camera, degrees), "gtao");
    expect_same_mean(upper_wall("perspective", degrees), "bitmask");
  }
}

}  // namespace
}  // namespace gloam::test::one_slice_test
