// What is measured first where the time is limited.
#include "measure/schedule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gloam/technique.h"

namespace gloam::bench::schedule_test {
namespace {

TEST(Schedule, ALimitEndsAtItsTimeAndPartsEndEarlier) {
  double now = 100;
  TimeLimit limit(60, [&] { return now; });
  EXPECT_DOUBLE_EQ(limit.left(), 60);
  TimeLimit half = limit.part(0.5);
  now = 129;
  EXPECT_TRUE(half.allows(1));
  EXPECT_FALSE(half.allows(1.001));
  now = 130;
  EXPECT_TRUE(half.is_over());
  EXPECT_FALSE(limit.is_over());
  limit.extend(10);
  EXPECT_DOUBLE_EQ(limit.left(), 40);
  now = 170;
  EXPECT_TRUE(limit.is_over());
  EXPECT_TRUE(limit.part(0.5).is_over());
}

TEST(Schedule, WithoutALimitEverythingFits) {
  const TimeLimit none;
  EXPECT_FALSE(none.is_set());
  EXPECT_FALSE(none.is_over());
  EXPECT_TRUE(none.allows(1e9));
  EXPECT_FALSE(none.part(0.1).is_set());
}

TEST(Schedule, DistancesAreToTheFastestThatIsAsNear) {
  // The second is on the front, the third is as near as the second in twice the time, the fourth is faster than all.
  const std::vector<double> distances = distances_to_front({{40, 0.1}, {10, 0.1}, {20, 0.1}, {5, 0.2}, {12, 0.2}});
  EXPECT_EQ(distances, (std::vector<double>{4, 1, 2, 1, 2.4}));
}

TEST(Schedule, WithoutErrorsNothingIsFarFromTheFront) {
  EXPECT_EQ(distances_to_front({{40, {}}, {10, {}}}), (std::vector<double>{1, 1}));
}

std::vector<Variation> variations() {
  const Technique &gtao = find_technique("gtao"), &hbao = find_technique("hbao");
  Variation half{.technique = &gtao, .preset = "medium", .variant = "half", .resolution = 2};
  Variation precise{.technique = &gtao, .preset = "medium", .variant = "precise", .math = Math::precise};
  return {{.technique = &gtao, .preset = "low"}, {.technique = &gtao, .preset = "medium"}, half, precise,
          {.technique = &hbao, .preset = "low"}, {.technique = &hbao, .preset = "high"}};
}

TEST(Schedule, FirstComesOnePresetOfEachTechnique) {
  EXPECT_EQ(first_looks(variations(), "medium"), (std::vector<size_t>{1, 4}));  // hbao has no medium here: its first
  EXPECT_EQ(first_looks(variations(), "low"), (std::vector<size_t>{0, 4}));
}

TEST(Schedule, ThenComeTechniquesNearTheFrontAndLowerResolutionsBeforePresets) {
  const auto far_is = [](const char* name) {
    return [name](const Variation& v) { return v.technique->name == name ? 3.0 : 1.0; };
  };
  EXPECT_EQ(later_looks(variations(), {1, 4}, far_is("hbao")), (std::vector<size_t>{2, 0, 5, 3}));
  EXPECT_EQ(later_looks(variations(), {1, 4}, far_is("gtao")), (std::vector<size_t>{5, 2, 0, 3}));
}

TEST(Schedule, TimesAreToldInWords) {
  EXPECT_EQ(time_words(41.6), "42 s");
  EXPECT_EQ(time_words(60), "1 min");
  EXPECT_EQ(time_words(90), "1 min 30 s");
  EXPECT_EQ(time_words(-3), "0 s");
}

}  // namespace
}  // namespace gloam::bench::schedule_test
