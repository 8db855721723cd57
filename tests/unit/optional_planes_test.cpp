// Planes that a technique reads where the frame has them, extras that a second pass completes, and parameters that are files.
#include <gtest/gtest.h>

#include <algorithm>

#include "gloam/plan.h"
#include "unit/message_of.h"

namespace gloam::test::optional_planes_test {
namespace {

using Names = std::vector<std::string>;

Plan plan_of(const PlanRequest& request, const Names& available) {
  return make_plan(request, available, "frame.exr has only Z");
}

Names labels_of(const Plan& plan) {
  Names labels;
  for (const PlannedPass& planned : plan.passes) labels.push_back(planned.label());
  return labels;
}

bool has_define(const Plan& plan, const std::string& name) {
  const Defines& defines = plan.passes.front().pass.defines;
  return std::any_of(defines.begin(), defines.end(), [&](const auto& define) { return define.first == name; });
}

TEST(OptionalPlanes, AreReadWhereTheFrameHasThem) {
  const Plan with = plan_of({.outputs = {"evidence"}}, {"depth", "normal", "back_depth"});
  EXPECT_EQ(with.inputs, (Names{"depth", "normal", "back_depth"}));
  EXPECT_TRUE(has_define(with, "WITH_BACK_DEPTH"));
  const Plan without = plan_of({.outputs = {"evidence"}}, {"depth", "normal"});
  EXPECT_EQ(without.inputs, (Names{"depth", "normal"}));
  EXPECT_FALSE(has_define(without, "WITH_BACK_DEPTH"));
}

// indirect could make AO of its own, which the same filter would follow.
TEST(Filters, FollowTheTechniqueThatMakesWhatTheyFilter) {
  const Names available = {"depth", "normal", "color", "albedo"};
  const auto width_of = [&](const Names& outputs) {
    const Plan plan = plan_of({.outputs = outputs}, available);
    const auto filter = std::find_if(plan.passes.begin(), plan.passes.end(),
                                     [](const PlannedPass& planned) { return planned.technique->name == "bilateral"; });
    return filter == plan.passes.end() ? "none" : filter->values.text("half_width");
  };
  EXPECT_EQ(width_of({"evidence"}), "3");
  EXPECT_EQ(width_of({"evidence", "indirect"}), "3");
}

TEST(OptionalPlanes, AreSubsampledLikeOthers) {
  const Plan plan = plan_of({.outputs = {"evidence"}, .resolution = 2}, {"depth", "normal", "back_depth"});
  const Names labels = labels_of(plan);
  EXPECT_NE(std::find(labels.begin(), labels.end(), "resample/subsample back_depth"), labels.end());
}

TEST(OptionalPlanes, AreReadByTheTechniqueElsewhereToo) {
  const Plan plan = plan_of({.outputs = {"gtao"}, .only = "mask", .elsewhere = "evidence"},
                            {"depth", "normal", "mask", "back_depth"});
  EXPECT_NE(std::find(plan.inputs.begin(), plan.inputs.end(), "back_depth"), plan.inputs.end());
}

TEST(OptionalPlanes, AreNotReadByRowsThatKnowTheLayers) {
  const Plan plan = plan_of({.outputs = {"dp-evidence"}}, {"depth", "normal", "back_depth", "peel.00", "peel.01"});
  EXPECT_EQ(plan.inputs, (Names{"depth", "normal", "peel.00", "peel.01"}));
}

TEST(ExtrasInTwoSteps, AreCompletedOnlyWhereTheyAreAskedFor) {
  EXPECT_EQ(labels_of(plan_of({.outputs = {"evidence"}, .filter = "none"}, {"depth", "normal"})),
            (Names{"evidence/estimate", "evidence/isolated"}));
  const Plan plan = plan_of({.outputs = {"evidence"}, .with = {"ao_error"}, .filter = "none"}, {"depth", "normal"});
  EXPECT_EQ(labels_of(plan), (Names{"evidence/estimate", "evidence/isolated", "evidence/filter error"}));
  EXPECT_EQ(plan.outputs, (Names{"ao_raw", "ao_error"}));
}

TEST(ExtrasForOthers, AreMadeWhereAnotherTechniqueReadsThem) {
  const Plan plan = plan_of({.outputs = {"specular-occlusion"}}, {"depth", "normal", "roughness"});
  EXPECT_EQ(labels_of(plan),
            (Names{"evidence/estimate", "evidence/isolated", "specular-occlusion/rows", "specular-occlusion/columns"}));
  EXPECT_EQ(plan.outputs, (Names{"specular_occlusion"}));
  EXPECT_TRUE(has_define(plan, "WITH_SPECULAR_OCCLUSION_RAW"));
  EXPECT_TRUE(has_define(plan, "WITH_LOBE_WEIGHT"));
  EXPECT_FALSE(has_define(plan, "WITH_CONE"));
}

TEST(ExtrasForOthers, ComeFromTheTechniqueAskedFor) {
  const Plan plan =
      plan_of({.outputs = {"gtao", "specular-occlusion"}, .filter = "none"}, {"depth", "normal", "roughness"});
  EXPECT_EQ(labels_of(plan), (Names{"gtao/estimate", "specular-occlusion/rows", "specular-occlusion/columns"}));
}

TEST(ExtrasForOthers, AreTakenFromTheFrame) {
  const Plan plan = plan_of({.outputs = {"specular-occlusion"}},
                            {"depth", "normal", "roughness", "specular_occlusion_raw", "lobe_weight"});
  EXPECT_EQ(labels_of(plan), (Names{"specular-occlusion/rows", "specular-occlusion/columns"}));
}

TEST(PlanesReadForExtras, AreReadForThemAlone) {
  EXPECT_EQ(plan_of({.outputs = {"gtao"}}, {"depth", "normal", "roughness"}).inputs, (Names{"depth", "normal"}));
  const Plan plan =
      plan_of({.outputs = {"gtao"}, .with = {"specular_occlusion_raw"}}, {"depth", "normal", "roughness"});
  EXPECT_EQ(plan.inputs, (Names{"depth", "normal", "roughness"}));
  EXPECT_EQ(message_of([] {
              plan_of({.outputs = {"gtao"}, .with = {"lobe_weight"}}, {"depth", "normal"});
            }),
            "gtao: needs 'roughness', and frame.exr has only Z (see docs/gbuffer.md)");
}

TEST(ReadsByParameter, AreThoseOfTheMethod) {
  const Names frame = {"depth", "normal", "roughness", "ao", "bent_normal", "cone"};
  const auto inputs = [&](const Settings& settings) {
    return plan_of({.outputs = {"specular-occlusion"}, .settings = settings}, frame).inputs;
  };
  EXPECT_EQ(inputs({{"method", "lagarde"}}), (Names{"depth", "normal", "roughness", "ao"}));
  EXPECT_EQ(inputs({{"specular-occlusion.method", "cone"}}),
            (Names{"depth", "normal", "roughness", "bent_normal", "cone"}));
  EXPECT_EQ(message_of([&] {
              inputs({{"method", "guess"}});
            }),
            "specular-occlusion: method = 'guess' is not allowed; sectors, cone, lagarde is");
}

TEST(SpecularOcclusion, IsReadByReflectionsThatHaveAnEnvironment) {
  const Names frame = {"depth", "normal", "color", "roughness", "reflectance", "specular_occlusion"};
  const auto reads_it = [&](const Settings& settings) {
    const Names inputs = plan_of({.outputs = {"sssr"}, .settings = settings}, frame).inputs;
    return std::find(inputs.begin(), inputs.end(), "specular_occlusion") != inputs.end();
  };
  EXPECT_FALSE(reads_it({}));
  EXPECT_TRUE(reads_it({{"environment_g", "1"}}));
}

TEST(FileParameter, IsNoneUntilItIsSet) {
  ParameterValues values(find_technique("evidence").parameters);
  EXPECT_EQ(values.text("coefficients"), "none");
  values.set("coefficients", "my.json", "evidence");
  EXPECT_EQ(values.text("coefficients"), "my.json");
  EXPECT_EQ(file_name(int(values.number("coefficients"))), "my.json");
  values.set("coefficients", "none", "evidence");
  EXPECT_EQ(values.text("coefficients"), "none");
  EXPECT_EQ(message_of([&] { values.set("coefficients", "", "evidence"); }),
            "evidence: coefficients = '' is not allowed; a file, or none is");
}

TEST(FileParameter, ThatCannotBeReadIsNamed) {
  EXPECT_EQ(message_of([] {
              plan_of({.outputs = {"evidence"}, .settings = {{"coefficients", "/nowhere.json"}}}, {"depth", "normal"});
            }),
            "/nowhere.json: cannot read: No such file or directory");
}

}  // namespace
}  // namespace gloam::test::optional_planes_test
