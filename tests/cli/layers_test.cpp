// Peeled layers at the command line: reports, decoding, refusals.
#include "cli/gloam_process.h"
#include "gloam/planes.h"
#include "support/stress.h"

namespace gloam::test::layers_test {
namespace {

using Json = nlohmann::json;

Frame layered(int layers) {
  Frame frame = shoot(perspective(48, 32), room());
  for (int number = 0; number < layers; ++number) invent_plane(frame, layer_name("peel", number));
  return frame;
}

bool holds(const Json& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

TEST_F(Cli, PlanOfLayersNamesEveryChannel) {
  write_frame(path("frame.exr"), layered(3));
  const Result result =
      gloam({"plan", "dp-hbao+", path("frame.exr"), "--json", "-"}, {{"OCL_ICD_VENDORS", "/nonexistent"}});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json plan = result.json();
  EXPECT_EQ(plan["passes"][0]["reads"], Json({"depth", "normal", "peel"}));
  Json decoded = plan["decoded"];
  std::sort(decoded.begin(), decoded.end());
  EXPECT_EQ(decoded, Json({"N.X", "N.Y", "N.Z", "Z", "peel.00.Z", "peel.01.Z", "peel.02.Z"}));
}

TEST_F(Cli, LayersRunAndAreToldInTheFigures) {
  write_frame(path("frame.exr"), layered(2));
  const Result result = gloam({"run", "dp-hbao+", path("frame.exr"), "-o", path("ao.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["passes"][0]["name"], "dp-hbao+/estimate");
  EXPECT_TRUE(holds(gloam({"info", path("frame.exr"), "--json", "-"}).json()["runs"], "dp-hbao+"));
  EXPECT_EQ(FrameFile(path("ao.exr"), {}).all_channels(), (Arguments{"AO", "Y"}));
}

TEST_F(Cli, WithoutLayersTheErrorTellsHowToGetThem) {
  write_frame(path("frame.exr"), layered(0));
  const Result result = gloam({"run", "dp-hbao+", path("frame.exr"), "-o", path("ao.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("needs 'peel'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("gloam capture --peel N"), std::string::npos) << result.err;
  EXPECT_EQ(gloam({"info", path("frame.exr"), "--json", "-"}).json()["lacks"]["dp-hbao+"], Json({"peel"}));
}

/// The cheapest remedy comes first, and the alternative after it.
TEST_F(Cli, WithoutLayersStochasticDepthIsAskedForByItsOwnName) {
  write_frame(path("frame.exr"), layered(0));
  for (const char* technique : {"sd-hbao+", "sd-ssao", "multiview"}) {
    const Result result = gloam({"run", technique, path("frame.exr"), "-o", path("ao.exr")});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find("needs 'stochastic'"), std::string::npos) << result.err;
    const size_t map = result.err.find("gloam capture --stochastic S"),
                 layers = result.err.find("gloam capture --peel N");
    ASSERT_NE(layers, std::string::npos) << result.err;
    EXPECT_LT(map, layers) << result.err;
  }
  const Json lacks = gloam({"info", path("frame.exr"), "--json", "-"}).json()["lacks"];
  EXPECT_EQ(lacks["sd-hbao+"], Json({"stochastic"}));
  EXPECT_EQ(lacks["stochastic-depth"], Json({"peel"}));
  EXPECT_EQ(lacks["multiview"], Json({"stochastic", "a second view"}));
  EXPECT_NE(gloam({"info", path("frame.exr"), "--lacks"}).out.find("lacks  sd-hbao+: stochastic or peel\n"),
            std::string::npos);
}

TEST_F(Cli, AMapOfStochasticDepthIsNotMadeOfItself) {
  Frame frame = shoot(perspective(48, 32), room());
  invent_plane(frame, layer_name("stochastic", 0));
  write_frame(path("frame.exr"), frame);
  const Result result = gloam({"run", "stochastic-depth", path("frame.exr"), "-o", path("map.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("needs 'peel'"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("as well"), std::string::npos) << result.err;
}

TEST_F(Cli, TwoViewsAreAskedForWhereTheyAreNeeded) {
  Frame frame = layered(2);
  frame.views[0].camera->pose = Pose{};
  frame.views[0].name = "one";
  write_frame(path("one.exr"), frame);
  const Json one = gloam({"info", path("one.exr"), "--json", "-"}).json();
  EXPECT_FALSE(holds(one["runs"], "multiview"));
  EXPECT_EQ(one["lacks"]["multiview"], Json({"a second view"}));
  frame.views.push_back(std::move(layered(2).views[0]));
  frame.views[1].name = "two";
  write_frame(path("two.exr"), frame);
  EXPECT_EQ(gloam({"info", path("two.exr"), "--json", "-"}).json()["lacks"]["multiview"], Json({"cameras with poses"}));
  frame.views[1].camera->pose = Pose{};
  write_frame(path("two.exr"), frame);
  EXPECT_TRUE(holds(gloam({"info", path("two.exr"), "--json", "-"}).json()["runs"], "multiview"));
  EXPECT_EQ(gloam({"run", "multiview", path("two.exr"), "-o", path("ao.exr")}).status, 0);
}

}  // namespace
}  // namespace gloam::test::layers_test
