// The settings that hard cases try of each technique.
#include <gtest/gtest.h>

#include <algorithm>

#include "gloam/compute.h"
#include "stress/outputs.h"

namespace gloam::test::stress_variants_test {
namespace {

Frame wall() {
  constexpr int width = 16, height = 9;
  return frame_from({.width = width,
                     .height = height,
                     .camera = camera_with_fov(width, height, 60),
                     .planes = {{"depth", std::vector<float>(width * height, 4.0f)}}});
}

TEST(StressVariants, AreThoseThatCanBePlanned) {
  size_t count = 0;
  for (const Technique& technique : registry()) {
    Frame frame = wall();
    for (const Settings& settings : stress::variants(technique, frame)) {
      EXPECT_NO_THROW(stress::plan_for(technique, frame, settings)) << technique.name;
      ++count;
    }
  }
  EXPECT_GT(count, 3 * registry().size());
}

TEST(StressVariants, OfAMapAreAllWhereNothingRefusesThem) {
  const auto tries_relevant = [](const char* technique) {
    Frame frame = wall();
    const std::vector<Settings> all = stress::variants(find_technique(technique), frame);
    return std::any_of(all.begin(), all.end(), [](const Settings& settings) {
      return std::find(settings.begin(), settings.end(),
                       std::pair<std::string, std::string>("stochastic-depth.surfaces", "relevant")) != settings.end();
    });
  };
  EXPECT_TRUE(tries_relevant("sd-hbao+"));
  EXPECT_FALSE(tries_relevant("multiview"));
}

}  // namespace
}  // namespace gloam::test::stress_variants_test
