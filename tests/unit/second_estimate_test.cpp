// Two estimates of one image: fewer samples where AO hardly varies (--adaptive), and another technique outside a mask
// (--elsewhere). Which rows get which, and that each row has the bits of its own estimate computed everywhere.
#include <gtest/gtest.h>

#include <algorithm>

#include "gloam/error.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "gloam/run.h"
#include "support/stress.h"
#include "support/techniques.h"
#include "unit/message_of.h"

namespace gloam::test::second_estimate_test {
namespace {

using Names = std::vector<std::string>;

Plan plan_of(const PlanRequest& request, const Names& available = {"depth", "normal"}) {
  return make_plan(request, available, "frame.exr has only Z");
}

Names labels_of(const Plan& plan) {
  Names labels;
  for (const PlannedPass& pass : plan.passes) labels.push_back(pass.label());
  return labels;
}

RunResult result_of(Frame& frame, const PlanRequest& request, int lanes = 0) {
  return run(make_plan(request, plane_names(frame), "the frame has not"), frame, device(),
             {.math = Math::precise, .lanes = lanes});
}

/// Numbers of tiles of 16 x `rows` pixels whose planes all have the bits of one result, of the other, or of both; every tile is
/// one of these.
struct Shares {
  int of_one = 0, of_other = 0, of_both = 0;
};

Shares shares(const Frame& mixed, const Frame& one, const Frame& other, int rows) {
  Shares found;
  for (int top = 0; top < mixed.height(); top += rows) {
    for (int left = 0; left < mixed.width(); left += 16) {
      bool is_one = true, is_other = true;
      for (const auto& [name, plane] : mixed.views[0].planes) {
        for (size_t i = 0; i < plane.channels.size(); ++i) {
          for (int y = top; y < std::min(top + rows, mixed.height()); ++y) {
            for (int x = left; x < std::min(left + 16, mixed.width()); ++x) {
              const float value = plane.channels[i].at(x, y);
              is_one &= value == one.views[0].find(name)->channels[i].at(x, y);
              is_other &= value == other.views[0].find(name)->channels[i].at(x, y);
            }
          }
        }
      }
      EXPECT_TRUE(is_one || is_other) << "the tile at " << left << ", " << top << " is of neither";
      ++(is_one && is_other ? found.of_both : is_one ? found.of_one : found.of_other);
    }
  }
  return found;
}

// --- Adaptive

struct Case {
  const Technique* technique;
  int lanes;
};

PlanRequest request_for(const Case& c, const std::string& preset, const std::string& adaptive = "",
                        const std::string& least_range = "", const std::string& filter = "none") {
  PlanRequest request{.outputs = {c.technique->name},
                      .with = unfiltered_extras(*c.technique),
                      .filter = filter,
                      .preset = preset,
                      .settings = {{"radius", "0.3"}},
                      .adaptive = adaptive};
  if (!least_range.empty()) request.settings.emplace_back("adaptive.least_range", least_range);
  return request;
}

class Adaptive : public ::testing::TestWithParam<Case> {};

TEST_P(Adaptive, EachTileHasTheBitsOfOnePreset) {
  Frame frame = shoot(perspective(203, 90), room());
  invent_for_extras(*GetParam().technique, frame);
  const RunResult full = result_of(frame, request_for(GetParam(), "medium"), GetParam().lanes);
  const RunResult low = result_of(frame, request_for(GetParam(), "low"), GetParam().lanes);
  const RunResult mixed = result_of(frame, request_for(GetParam(), "medium", "low", "0.3"), GetParam().lanes);
  const Shares found = shares(mixed.frame, full.frame, low.frame, 16);
  EXPECT_GE(found.of_one, 3);
  EXPECT_GE(found.of_other, 3);
  EXPECT_GT(mixed.rest_share, 0.05);
  EXPECT_LT(mixed.rest_share, 0.95);
  EXPECT_EQ(full.rest_share, 0);
}

/// One pixel of each tile, which the base pass does not see, lies before its neighbours: no filter averages it.
TEST(AdaptiveEvidence, IsolatedPixelsHaveTheSlicesOfTheirTile) {
  Frame frame = shoot(perspective(203, 90), room());
  invent_for_extras(find_technique("evidence"), frame);
  Channel& depth = frame.views[0].planes.at("depth").channels[0];
  for (int y = 7; y < frame.height(); y += 16) {
    for (int x = 5; x < frame.width(); x += 16) depth.at(x, y) *= 0.7f;
  }
  const Case c{&find_technique("evidence"), 0};
  const RunResult full = result_of(frame, request_for(c, "medium")), low = result_of(frame, request_for(c, "low"));
  PlanRequest few = request_for(c, "medium");
  few.settings.emplace_back("edge_factor", "1");
  ASSERT_FALSE(same_bits(full.frame, result_of(frame, few).frame)) << "no pixel is isolated";
  const RunResult mixed = result_of(frame, request_for(c, "medium", "low", "0.3"));
  const Shares found = shares(mixed.frame, full.frame, low.frame, 16);
  EXPECT_GE(found.of_one, 3);
  EXPECT_GE(found.of_other, 3);
}

TEST_P(Adaptive, TheLeastRangeDecides) {
  Frame frame = shoot(orthographic(67, 45, 4), room());
  invent_for_extras(*GetParam().technique, frame);
  for (const std::string filter : {"", "none"}) {
    const auto frame_of = [&](const std::string& preset, const std::string& adaptive, const std::string& least_range) {
      return std::move(
          result_of(frame, request_for(GetParam(), preset, adaptive, least_range, filter), GetParam().lanes).frame);
    };
    EXPECT_TRUE(same_bits(frame_of("medium", "low", "0"), frame_of("medium", "", ""))) << filter;
    EXPECT_TRUE(same_bits(frame_of("medium", "low", "1"), frame_of("low", "", ""))) << filter;
    EXPECT_TRUE(same_bits(frame_of("medium", "none", ""), frame_of("medium", "", ""))) << filter;
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Technique& technique : registry()) {
    const bool has_presets = !technique.presets.empty();
    const bool makes_ao = std::count(technique.writes.begin(), technique.writes.end(), "ao_raw") > 0;
    const bool is_one_estimate = technique.name != "multires";
    if (technique.reads == Names{"depth", "normal"} && technique.views == 1 && makes_ao && has_presets &&
        is_one_estimate)
      all.push_back({&technique, 0});
  }
  for (const int lanes : {1, 4, 8}) all.push_back({&find_technique("ssao"), lanes});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Adaptive, ::testing::ValuesIn(cases()), [](const auto& info) {
  return identifier(info.param.technique->name) +
         (info.param.lanes > 0 ? fmt::format("_{}_lanes", info.param.lanes) : "");
});

TEST(AdaptivePlan, AFlatWallNeedsFewSamplesAndACornerMany) {
  Frame wall = shoot(perspective(128, 64), tilted_plane(3, 0.4, 1));
  EXPECT_EQ(result_of(wall, {.outputs = {"gtao"}, .preset = "ultra", .adaptive = "low"}).rest_share, 1);
  Frame all = shoot(perspective(128, 64), room());
  const double share = result_of(all, {.outputs = {"gtao"}, .preset = "ultra", .adaptive = "low"}).rest_share;
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.9);
}

TEST(AdaptivePlan, WhatAMaskLeavesOutStaysOpen) {
  Frame frame = shoot(perspective(151, 90), room());
  Channel& mask = plane_of(frame, "mask").channels[0];
  for (int y = 20; y < 60; ++y) std::fill_n(mask.row(y) + 50, 60, 1.0f);
  PlanRequest request{.outputs = {"gtao"}, .preset = "high", .only = "mask", .adaptive = "low"};
  const RunResult masked = result_of(frame, request);
  request.only = "";
  const RunResult whole = result_of(frame, request);
  EXPECT_GT(masked.skipped_share, 0.2);
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const float expected = mask.at(x, y) > 0 ? whole.frame.views[0].find("ao")->channels[0].at(x, y) : 1;
      ASSERT_EQ(masked.frame.views[0].find("ao")->channels[0].at(x, y), expected) << x << ", " << y;
    }
  }
}

TEST(AdaptivePlan, TheBasePassIsMadeOfTheTechniquesOwn) {
  EXPECT_EQ(
      labels_of(plan_of({.outputs = {"gtao"}, .preset = "ultra", .adaptive = "medium"})),
      (Names{"resample/subsample depth", "resample/subsample normal", "gtao/estimate", "bilateral/separable",
             "adaptive/tiles", "mask/bits", "gtao/estimate", "gtao/estimate of the rest", "bilateral/separable"}));
}

TEST(AdaptivePlan, TheBasePassDoesWithoutAFilterWhereThePlanDoes) {
  const Plan plan = plan_of({.outputs = {"gtao"}, .only_outputs = {"ao_raw"}, .preset = "ultra", .adaptive = "medium"});
  EXPECT_EQ(labels_of(plan), (Names{"resample/subsample depth", "resample/subsample normal", "gtao/estimate",
                                    "adaptive/tiles", "mask/bits", "gtao/estimate", "gtao/estimate of the rest"}));
  EXPECT_EQ(plan.outputs, Names{"ao_raw"});
}

TEST(AdaptivePlan, WhatCannotBeIsSaidInOneLine) {
  const auto message = [](const PlanRequest& request, const Names& available = {"depth", "normal"}) {
    return message_of([&] { plan_of(request, available); });
  };
  EXPECT_EQ(message({.outputs = {"gtao"}, .adaptive = "middle"}),
            "--adaptive middle: gtao has no such preset; it has low, medium, high and ultra");
  EXPECT_EQ(message({.outputs = {"gtao"}, .resolution = 2, .adaptive = "low"}),
            "--adaptive low: works at full resolution; leave out --resolution");
  EXPECT_EQ(message({.outputs = {"dp-gtao"}, .adaptive = "low"}, {"depth", "normal", "peel.00", "peel.01"}),
            "--adaptive low: dp-gtao reads further layers, which a base pass does not; leave --adaptive out");
  EXPECT_EQ(message({.outputs = {"stereo-gtao"}, .adaptive = "low"}),
            "--adaptive low: stereo-gtao reads two views, which a base pass does not; leave --adaptive out");
  EXPECT_EQ(message({.outputs = {"normals"}, .adaptive = "low"}),
            "--adaptive low: varies the samples of ambient occlusion, and normals makes normal; leave --adaptive out");
  EXPECT_EQ(
      message({.outputs = {"indirect"}, .adaptive = "low"}, {"depth", "normal", "color"}),
      "--adaptive low: varies the samples of ambient occlusion, and indirect makes indirect_raw; leave --adaptive "
      "out");
  EXPECT_EQ(message({.outputs = {"multires"}, .adaptive = "low"}),
            "--adaptive low: multires has no estimate that can skip pixels; leave --adaptive out");
}

// --- Elsewhere

/// Some blocks, none of them along rows of 16 pixels.
void add_mask(Frame& frame) {
  Channel& mask = plane_of(frame, "mask").channels[0];
  for (int block = 0; block < 6; ++block) {
    const int left = 5 + 27 * block, top = 3 + 5 * block;
    for (int y = top; y < std::min(top + 7, frame.height()); ++y)
      std::fill_n(mask.row(y) + left, std::min(9, frame.width() - left), 0.25f);
  }
}

TEST(Elsewhere, EachRowOfSixteenHasTheBitsOfOneTechnique) {
  for (const int lanes : {1, 4, 8, 16}) {
    Frame frame = shoot(perspective(163, 47), room());
    add_mask(frame);
    const auto result = [&](const std::string& technique, const std::string& elsewhere) {
      return result_of(frame,
                       {.outputs = {technique},
                        .with = {"bent_normal", "cone"},
                        .filter = "none",
                        .only = elsewhere.empty() ? "" : "mask",
                        .elsewhere = elsewhere},
                       lanes);
    };
    const RunResult one = result("bitmask", ""), other = result("gtao", ""), mixed = result("bitmask", "gtao");
    const Shares found = shares(mixed.frame, one.frame, other.frame, 1);
    EXPECT_GT(found.of_one, 20) << lanes;
    EXPECT_GT(found.of_other, 100) << lanes;
    EXPECT_GT(mixed.rest_share, 0.5) << lanes;
    EXPECT_LT(mixed.rest_share, 1) << lanes;
    EXPECT_EQ(mixed.skipped_share, 0) << lanes;
  }
}

TEST(Elsewhere, TheFilterCoversTheImage) {
  Frame frame = shoot(perspective(83, 47), room());
  plane_of(frame, "nothing");
  for (int y = 0; y < frame.height(); ++y)
    std::fill_n(plane_of(frame, "everything").channels[0].row(y), frame.width(), 1.0f);
  const auto frame_of = [&](const std::string& technique, const std::string& mask, const std::string& elsewhere) {
    return std::move(result_of(frame, {.outputs = {technique}, .only = mask, .elsewhere = elsewhere}).frame);
  };
  EXPECT_TRUE(same_bits(frame_of("bitmask", "everything", "gtao"), frame_of("bitmask", "", "")));
  EXPECT_TRUE(same_bits(frame_of("bitmask", "nothing", "gtao"), frame_of("gtao", "", "")));
}

TEST(Elsewhere, AnExtraThatIsFilteredChangesNoBitOfTheEstimates) {
  Frame frame = shoot(perspective(163, 47), room());
  add_mask(frame);
  invent_plane(frame, "stochastic");
  invent_plane(frame, "back_depth");
  const auto frame_of = [&](const std::string& technique, const std::string& elsewhere, const Names& with) {
    PlanRequest request{.outputs = {technique}, .with = with, .filter = "none", .elsewhere = elsewhere};
    if (!elsewhere.empty()) request.only = "mask";
    if (technique == "sd-evidence") request.settings = {{"samples", "3"}};  // as many as are invented
    return std::move(result_of(frame, request).frame);
  };
  const Frame mixed = frame_of("sd-evidence", "evidence", {});
  Frame with_error = frame_of("sd-evidence", "evidence", {"ao_error"});
  EXPECT_EQ(with_error.views[0].planes.erase("ao_error"), 1u);
  EXPECT_TRUE(same_bits(with_error, mixed));
  const Shares found = shares(mixed, frame_of("sd-evidence", "", {}), frame_of("evidence", "", {}), 1);
  EXPECT_GT(found.of_one, 20);
  EXPECT_GT(found.of_other, 100) << "with back_depth, as by itself";
}

TEST(Elsewhere, BothMaySortLayersOfTheirOwn) {
  Frame frame = shoot(perspective(163, 47), room());
  add_mask(frame);
  invent_plane(frame, "stochastic");
  const auto frame_of = [&](const std::string& technique, const std::string& elsewhere) {
    PlanRequest request{.outputs = {technique},
                        .filter = "none",
                        .settings = {{technique + ".samples", technique == "sd-gtao" ? "2" : "3"}}};
    if (!elsewhere.empty()) {
      request.only = "mask";
      request.elsewhere = elsewhere;
      request.settings.emplace_back(elsewhere + ".samples", elsewhere == "sd-gtao" ? "2" : "3");
    }
    return std::move(result_of(frame, request).frame);
  };
  for (const char* first : {"sd-gtao", "sd-bitmask"}) {
    const std::string second = std::string(first) == "sd-gtao" ? "sd-bitmask" : "sd-gtao";
    const Shares found = shares(frame_of(first, second), frame_of(first, ""), frame_of(second, ""), 1);
    EXPECT_GT(found.of_one, 20) << first;
    EXPECT_GT(found.of_other, 100) << first;
  }
}

TEST(Elsewhere, SettingsReachBothAndOneByItsName) {
  const Plan plan = plan_of({.outputs = {"bitmask"},
                             .settings = {{"radius", "0.7"}, {"gtao.steps", "5"}},
                             .only = "corner-mask",
                             .elsewhere = "gtao"});
  for (const PlannedPass& planned : plan.passes) {
    if (planned.technique->name == "bitmask" || planned.technique->name == "gtao") {
      EXPECT_EQ(planned.values.number("radius"), 0.7f) << planned.label();
      EXPECT_EQ(planned.values.number("steps"), planned.technique->name == "gtao" ? 5 : 9);
    }
  }
}

TEST(Elsewhere, WhatCannotBeIsSaidInOneLine) {
  const auto message = [](const PlanRequest& request, const Names& available = {"depth", "normal", "mask"}) {
    return message_of([&] { plan_of(request, available); });
  };
  EXPECT_EQ(message({.outputs = {"bitmask"}, .elsewhere = "gtao"}), "--elsewhere gtao: needs a mask; add --only MASK");
  EXPECT_EQ(message({.outputs = {"gtao"}, .only = "mask", .elsewhere = "gtao"}),
            "--elsewhere gtao: also runs inside the mask; leave out --only and --elsewhere");
  EXPECT_NE(message({.outputs = {"gtao"}, .only = "mask", .elsewhere = "gtoa"}).find("did you mean 'gtao'"),
            std::string::npos);
  EXPECT_EQ(message({.outputs = {"gtao"}, .only = "mask", .elsewhere = "normals"}),
            "--elsewhere normals: makes normal, and gtao makes ao_raw; name an estimate of the same planes");
  EXPECT_EQ(message({.outputs = {"gtao"}, .with = {"cone"}, .only = "mask", .elsewhere = "hbao+"}),
            "--elsewhere hbao+: does not make 'cone', which is asked for; leave that out");
  EXPECT_EQ(message({.outputs = {"gtao"}, .only = "mask", .elsewhere = "ssao", .resolution = 2}),
            "--elsewhere ssao: works at full resolution; leave out --resolution");
  EXPECT_EQ(message({.outputs = {"gtao"}, .only = "mask", .elsewhere = "ssao", .adaptive = "low"}),
            "--elsewhere ssao: goes without --adaptive low; leave one of them out");
}

// --- Where hidden layers matter

/// A wall, and before it, out of reach, a square that hides a block on the wall, `block` high, in columns 60 to 80 and rows 30 to
/// 50.
Frame hidden_block(double block) {
  const Shot shot = orthographic(160, 80, 4);
  const auto is_before = [](const EyeRay& ray) {
    return std::abs(ray.origin.x + 0.25) < 0.25 && std::abs(ray.origin.y) < 0.25;
  };
  Frame frame = shoot(shot, [&](const EyeRay& ray) {
    return std::optional<Surface>({is_before(ray) ? 1.0 : 3.0, {0, 0, 1}});
  });
  plane_of(frame, "stochastic.00");
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const bool hides = is_before(ray_through(shot, x + 0.5, y + 0.5));
      plane_of(frame, "stochastic.00").channels[0].at(x, y) = hides ? float(3 - block) : 3;
    }
  }
  return frame;
}

PlanRequest hidden_mask(const Settings& more = {}) {
  PlanRequest request{.outputs = {"hidden-mask"},
                      .settings = {{"samples", "1"}, {"radius", "0.3"}, {"max_reach", "1"}}};
  request.settings.insert(request.settings.end(), more.begin(), more.end());
  return request;
}

TEST(HiddenMask, FindsWhatRisesBehindWhatIsSeen) {
  Frame frame = hidden_block(0.2);
  for (const char* cell : {"4", "8", "16"}) {
    const RunResult result = result_of(frame, hidden_mask({{"cell", cell}}));
    const Channel& mask = result.frame.views[0].find("mask")->channels[0];
    // Pixels beside the square have the block near; those further away than the radius (12 pixels) and two cells have nothing near.
    for (int y = 34; y < 46; ++y) {
      EXPECT_EQ(mask.at(57, y), 1) << y;
      EXPECT_EQ(mask.at(83, y), 1) << y;
    }
    for (int y = 0; y < frame.height(); ++y) {
      EXPECT_EQ(mask.at(10, y), 0) << y;
      EXPECT_EQ(mask.at(130, y), 0) << y;
    }
  }
}

TEST(HiddenMask, WhatGoesOnBehindDoesNotCount) {
  Frame wall = hidden_block(0);
  const RunResult result = result_of(wall, hidden_mask());
  for (int y = 0; y < wall.height(); ++y) {
    for (int x = 0; x < wall.width(); ++x) ASSERT_EQ(result.frame.views[0].find("mask")->channels[0].at(x, y), 0);
  }
}

TEST(HiddenMask, NorDoesWhatIsLowerThanWhatIsSeen) {
  // The same block without the square; it hides its own back.
  Frame frame = shoot(orthographic(160, 80, 4), [](const EyeRay& ray) {
    const bool is_block = std::abs(ray.origin.x) < 0.25;
    return std::optional<Surface>({is_block ? 2.8 : 3.0, {0, 0, 1}});
  });
  Channel& hidden = plane_of(frame, "stochastic.00").channels[0];
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x)
      hidden.at(x, y) = frame.views[0].find("depth")->channels[0].at(x, y) < 2.9f ? 2.9f : 3.0f;
  }
  const RunResult result = result_of(frame, hidden_mask());
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) ASSERT_EQ(result.frame.views[0].find("mask")->channels[0].at(x, y), 0);
  }
}

}  // namespace
}  // namespace gloam::test::second_estimate_test
