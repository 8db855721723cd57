// Restricting a run to a mask (--only): its plan, that no bit changes inside the mask, and that pixels left out are open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gloam/error.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "gloam/run.h"
#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"
#include "unit/message_of.h"

namespace gloam::test::mask_test {
namespace {

using Names = std::vector<std::string>;

// --- The plan

Plan plan_of(const PlanRequest& request, const Names& available = {"depth", "normal"}) {
  return make_plan(request, available, "frame.exr has only Z");
}

Names labels_of(const Plan& plan) {
  Names labels;
  for (const PlannedPass& pass : plan.passes) labels.push_back(pass.label());
  return labels;
}

/// The plane of bits by which a pass skips pixels; empty if it skips none.
std::string wanted_by(const Plan& plan, const std::string& label) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.label() != label) continue;
    for (const Binding& read : planned.pass.reads) {
      if (read.argument == "wanted") return read.plane;
    }
  }
  return "";
}

TEST(Mask, TheCellsOfAMaskDoWhereNobodyAsksForTheMaskItself) {
  const Plan plan = plan_of({.outputs = {"hbao+"}, .only = "corner-mask"});
  EXPECT_EQ(labels_of(plan), (Names{"corner-mask/subsample", "corner-mask/find", "corner-mask/grow", "mask/bits",
                                    "mask/grown", "hbao+/estimate", "bilateral/separable"}));
  const Plan with_mask = plan_of({.outputs = {"hbao+", "corner-mask"}, .only = "corner-mask"});
  EXPECT_NE(labels_of(with_mask), labels_of(plan));
  EXPECT_EQ(with_mask.outputs, (Names{"ao", "ao_raw", "mask"}));
}

TEST(Mask, TheEstimateCoversWhatFiltersReadAndTheLastFilterTheMask) {
  const Plan plan = plan_of({.outputs = {"gtao"}, .only = "mask"}, {"depth", "normal", "mask"});
  EXPECT_EQ(wanted_by(plan, "gtao/estimate"), "wanted.grown");
  EXPECT_EQ(wanted_by(plan, "bilateral/separable"), "wanted");
  const Plan wide =
      plan_of({.outputs = {"gtao"}, .settings = {{"half_width", "5"}}, .only = "mask"}, {"depth", "normal", "mask"});
  EXPECT_EQ(wanted_by(wide, "gtao/estimate"), "wanted.grown");
  EXPECT_EQ(wanted_by(wide, "bilateral/horizontal"), "wanted.grown");
  EXPECT_EQ(wanted_by(wide, "bilateral/vertical"), "wanted");
  const Plan unfiltered = plan_of({.outputs = {"gtao"}, .filter = "none", .only = "mask"}, {"depth", "normal", "mask"});
  EXPECT_EQ(labels_of(unfiltered), (Names{"mask/bits", "gtao/estimate"}));
  EXPECT_EQ(wanted_by(unfiltered, "gtao/estimate"), "wanted");
}

TEST(Mask, AMaskIsMadeOfAllPixelsAtEveryResolution) {
  const Plan plan = plan_of({.outputs = {"gtao", "corner-mask"}, .only = "corner-mask", .resolution = 2});
  size_t made = 0, used = 0;
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    if (plan.passes[i].label() == "corner-mask/spread") made = i;
    if (plan.passes[i].label() == "gtao/estimate") used = i;
  }
  EXPECT_LT(made, used);
  EXPECT_EQ(plan.passes[made].pass.scale, 1);
  EXPECT_EQ(plan.passes[used].pass.scale, 2);
}

TEST(Mask, AMaskIsMadeForTheRadiusOfWhatItRestricts) {
  const Plan plan = plan_of({.outputs = {"ssao"}, .settings = {{"ssao.radius", "0.7"}}, .only = "corner-mask"});
  ASSERT_EQ(plan.passes.front().technique->name, "corner-mask");
  EXPECT_EQ(plan.passes.front().values.number("radius"), 0.7f);
  EXPECT_EQ(plan.passes.front().values.number("range"), 2);
  EXPECT_EQ(plan_of({.outputs = {"gtao"}, .only = "corner-mask"}).passes.front().values.number("range"), 0);
}

TEST(Mask, WhatTheFileHoldsIsTakenAndATechniqueIsRun) {
  const Names available = {"depth", "normal", "mask"};
  EXPECT_EQ(plan_of({.outputs = {"gtao"}, .only = "mask"}, available).inputs, (Names{"mask", "depth", "normal"}));
  EXPECT_EQ(labels_of(plan_of({.outputs = {"gtao"}, .only = "corner-mask"}, available)).front(),
            "corner-mask/subsample");
}

TEST(Mask, WhatCannotBeIsSaidInOneLine) {
  const auto message = [](const PlanRequest& request, const Names& available = {"depth", "normal"}) {
    return message_of([&] { plan_of(request, available); });
  };
  EXPECT_EQ(
      message({.outputs = {"gtao"}, .only = "corner-mast"}),
      "--only corner-mast: is neither a plane at hand nor a technique that makes one (did you mean 'corner-mask'?); "
      "--plane mask=CHANNEL takes any channel of the file as 'mask'");
  EXPECT_EQ(message({.outputs = {"gtao"}, .only = "normal"}),
            "--only normal: 'normal' has several values per pixel; corner-mask makes a mask");
  EXPECT_EQ(message({.outputs = {"normals"}, .only = "depth"}),
            "--only: normals has no pass that a mask can restrict; leave --only out");
  EXPECT_EQ(message({.outputs = {"stereo-ao"}, .only = "corner-mask"}),
            "--only: restricts techniques that read one view, and stereo-ao reads two; leave --only out");
  EXPECT_EQ(
      message({.outputs = {"reflection-mask"}, .only = "corner-mask"}, {"depth", "normal", "roughness", "reflectance"}),
      "--only: reflection-mask makes 'mask' itself and cannot be restricted by it; leave --only out");
  // The mask and what it restricts make planes of the same names, one after the other.
  EXPECT_NO_THROW(plan_of({.outputs = {"sssr"}, .only = "reflection-mask"},
                          {"depth", "normal", "color", "roughness", "reflectance"}));
  for (const char* mask : {"ao", "ao_raw"}) {
    EXPECT_EQ(message({.outputs = {"gtao"}, .only = mask}),
              fmt::format("--only: gtao makes '{}' itself and cannot be restricted by it; leave --only out", mask));
  }
}

// --- What comes out

/// Some disks and single pixels, none on the left, far enough from the border that wide filters leave something out.
void add_mask(Frame& frame) {
  Channel& mask = plane_of(frame, "mask").channels[0];
  std::mt19937 random(7);
  const auto up_to = [&](int end) { return int(random() % unsigned(end)); };
  for (int i = 0; i < 12; ++i) {
    const int x0 = 70 + up_to(frame.width() - 70), y0 = up_to(frame.height()), radius = i < 6 ? 0 : 2 + up_to(6);
    for (int y = std::max(0, y0 - radius); y <= std::min(frame.height() - 1, y0 + radius); ++y) {
      for (int x = std::max(70, x0 - radius); x <= std::min(frame.width() - 1, x0 + radius); ++x) {
        if ((x - x0) * (x - x0) + (y - y0) * (y - y0) <= radius * radius) mask.at(x, y) = 0.5f;
      }
    }
  }
}

/// What is left out lies in rows of lanes with what is wanted, or does not: that must not show.
TEST(Mask, GivesTheSameBitsAtEveryLaneWidth) {
  for (const char* name : {"gtao", "sssr"}) {
    const Technique& technique = find_technique(name);
    Frame frame = shoot(perspective(65, 9), room());
    plan_for(technique, frame);  // adds invented planes
    invent_for_extras(technique, frame);
    plane_of(frame, "mask").channels[0].at(32, 4) = 1;
    const Plan plan =
        make_plan({.outputs = {name}, .with = technique.extras, .settings = few_samples(technique), .only = "mask"},
                  plane_names(frame), "the frame has not");
    const auto with_lanes = [&](int lanes) {
      return std::move(run(plan, frame, device(), {.math = Math::precise, .lanes = lanes}).frame);
    };
    EXPECT_TRUE(same_bits(with_lanes(16), with_lanes(1))) << name;
  }
}

/// Whether a technique makes AO of one view and can be restricted.
bool makes_ao(const Technique& technique) {
  return technique.views == 1 && std::count(technique.writes.begin(), technique.writes.end(), "ao_raw") > 0;
}

struct Case {
  const Technique* technique;
  int resolution, lanes;
};

class Masked : public ::testing::TestWithParam<Case> {
 protected:
  /// With the mask's plane; everywhere if it is empty.
  RunResult result_of(Frame& frame, const std::string& mask, const std::string& filter = "") {
    const Case& c = GetParam();
    plan_for(*c.technique, frame);  // adds invented planes
    invent_for_extras(*c.technique, frame);
    PlanRequest request{.outputs = {c.technique->name},
                        // Around the mask, what a filter of the technique reads is computed too.
                        .with = filter == "none" ? unfiltered_extras(*c.technique) : c.technique->extras,
                        .filter = filter,
                        .settings = few_samples(*c.technique),
                        .only = mask,
                        .resolution = c.resolution};
    return run(make_plan(request, plane_names(frame), "the frame has not"), frame, device(),
               {.math = Math::precise, .lanes = c.lanes});
  }
};

void expect_masked(const RunResult& masked, const RunResult& whole, const Frame& frame, const std::string& filter) {
  const Channel& mask = frame.views[0].find("mask")->channels[0];
  int inside = 0, outside = 0;
  for (const auto& [name, plane] : masked.frame.views[0].planes) {
    // Around the mask, the pixels that the filter reads are computed too.
    const bool is_filtered = name == "ao" || name == "ao_error" || filter == "none";
    const float left_out = plane_kind(name).outside;
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      const Channel& channel = plane.channels[i];
      const Channel& expected = whole.frame.views[0].find(name)->channels[i];
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const bool is_wanted = mask.at(x, y) > 0;
          if (is_wanted) {
            ASSERT_EQ(channel.at(x, y), expected.at(x, y)) << name << " at " << x << ", " << y;
            ++inside;
          } else if (is_filtered || (x < 4 && y < 8)) {
            ASSERT_EQ(channel.at(x, y), left_out) << name << " at " << x << ", " << y;
            ++outside;
          } else {
            ASSERT_TRUE(channel.at(x, y) == left_out || channel.at(x, y) == expected.at(x, y) || name.find("ao") != 0)
                << name << " at " << x << ", " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 300);
}

TEST_P(Masked, InsideNothingChangesAndOutsideIsOpen) {
  Frame frame = shoot(perspective(151, 45), room());
  add_mask(frame);
  for (const std::string filter : {"", "none", "gaussian"}) {
    // The filters do the same after each technique.
    if (filter == "gaussian" && GetParam().technique->name != "hbao+" && !is_long_run()) continue;
    SCOPED_TRACE("filter " + filter);
    const RunResult whole = result_of(frame, "", filter), masked = result_of(frame, "mask", filter);
    EXPECT_EQ(whole.skipped_share, 0);
    EXPECT_GT(masked.skipped_share, 0.05);
    expect_masked(masked, whole, frame, filter);
  }
}

TEST_P(Masked, WhereNothingIsWantedAllIsOpenAndWhereAllIsNothingChanges) {
  Frame frame = shoot(orthographic(47, 33, 4), room());
  plane_of(frame, "nothing");
  for (int y = 0; y < frame.height(); ++y)
    std::fill_n(plane_of(frame, "everything").channels[0].row(y), frame.width(), 1e-6f);
  const RunResult whole = result_of(frame, "");
  EXPECT_TRUE(same_bits(result_of(frame, "everything").frame, whole.frame));
  const RunResult nothing = result_of(frame, "nothing");
  EXPECT_EQ(nothing.skipped_share, 1);
  for (const auto& [name, plane] : nothing.frame.views[0].planes) {
    for (const Channel& channel : plane.channels) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) ASSERT_EQ(channel.at(x, y), plane_kind(name).outside) << name;
      }
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Technique& technique : registry()) {
    if (!makes_ao(technique)) continue;
    all.push_back({&technique, 1, 0});
    all.push_back({&technique, 2, 0});
  }
  // Code that all techniques share, at every width.
  for (const int lanes : {1, 4, 8}) all.push_back({&find_technique("ssao"), 1, lanes});
  all.push_back({&find_technique("ssao"), 4, 1});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Masked, ::testing::ValuesIn(cases()), [](const auto& info) {
  const Case& c = info.param;
  return identifier(c.technique->name) + (c.resolution > 1 ? fmt::format("_at_{}", c.resolution) : "") +
         (c.lanes > 0 ? fmt::format("_{}_lanes", c.lanes) : "");
});

}  // namespace
}  // namespace gloam::test::mask_test
