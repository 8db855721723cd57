// Peeled layers at the command line: what is told of them, decoded, and refused.
#include "gloam/planes.h"
#include "gloam_process.h"
#include "support/frames.h"

namespace gloam::test {
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
  EXPECT_EQ(FrameFile(path("ao.exr"), {}).all_channels().size(), 3u) << "AO, AO_raw and Z";
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

}  // namespace
}  // namespace gloam::test
