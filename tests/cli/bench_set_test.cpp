// gloam bench --set: gloam's own techniques on a set, beside submitted methods.
#include <set>

#include "cli/score_fixture.h"

namespace gloam::test::bench_set_test {
namespace {

using Json = nlohmann::json;

class BenchSet : public ScoreTest {
 protected:
  Result bench(const Arguments& more = {}) const {
    Arguments arguments = {"bench", "--set", path("set"), "-o", path("out"), "--presets", "low", "--rounds", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
};

TEST_F(BenchSet, MeasuresEveryItemAndKeepsSubmittedRows) {
  write_all([](float v) { return 0.9f * v; });
  ASSERT_EQ(score_images().status, 0);
  const Result result = bench({"--techniques", "hbao+,stereo-ao,indirect"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json made = document();
  EXPECT_EQ(made["set"]["name"], "test-1");
  EXPECT_EQ(made["gloam"].get<std::string>().substr(0, 2), "0.");
  std::set<std::string> kinds;
  for (const Json& each : made["results"]) {
    kinds.insert(each["kind"]);
    EXPECT_TRUE(each["ssim"].is_number()) << each["technique"];
    EXPECT_TRUE(each["flip"].is_number()) << each["technique"];
    EXPECT_TRUE(each["rmse_to_truth"].is_number());
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"eyes", "frame", "sequence"}));
  for (const char* item : {"room", "walk", "pair"}) {
    EXPECT_TRUE(row(item).is_object()) << item << ": submitted";
    const Json own = row(item, "hbao+");
    ASSERT_TRUE(own.is_object()) << item;
    EXPECT_GT(own["ms"]["median"], 0);
    EXPECT_GT(own["ratio_to_hbao_plus"], 0) << item;
  }
  EXPECT_TRUE(row("walk", "hbao+")["flicker"].is_number());
  EXPECT_TRUE(row("room", "hbao+")["flicker"].is_null());
  EXPECT_TRUE(row("pair", "hbao+")["inconsistency"].is_number());
  EXPECT_TRUE(row("pair", "stereo-ao").is_object());
  EXPECT_TRUE(row("room", "stereo-ao").is_null());
  EXPECT_TRUE(row("room", "indirect", "indirect").is_object());
  // the same image through gloam score has the same figures
  ok({"run", "hbao+", frame("room"), "-o", path("images/room_ao.exr"), "--float", "--preset", "low", "--set",
      "radius=0.5"});
  entry({{"name", "hbao+ again"}});
  ASSERT_EQ(score_images({"--items", "room"}).status, 0);
  for (const char* figure : {"rmse_to_truth", "bias", "ssim", "flip"})
    EXPECT_NEAR(row("room", "hbao+ again")[figure], row("room", "hbao+")[figure], 1e-5) << figure;
}

TEST_F(BenchSet, LeavesOutWhatIsNotTheSets) {
  fs::copy_file(frame("walk.0001"), frame("walk.0003"), fs::copy_options::overwrite_existing);
  const Result result = bench({"--techniques", "hbao+"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("gloam: walk: left out: " + frame("walk.0003") + ": is not the set's"), std::string::npos)
      << result.err;
  EXPECT_TRUE(row("room", "hbao+").is_object());
  EXPECT_TRUE(row("pair", "hbao+").is_object());
}

// The reference of ratios, hbao+, cannot compute views of a display.
TEST_F(BenchSet, MeasuresDisplaysBesideWhatComputesThem) {
  ok({"set", "make", "small", "--only", "display,corner", "-o", path("small")});
  const Result result = gloam({"bench", "--set", path("small"), "-o", path("out"), "--presets", "medium", "--rounds",
                               "1", "--techniques", "lightfield-hbao+,lightfield-ssao,gtao,ssao"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("ratios to HBAO+ are to lightfield-hbao+ medium"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("skipped gtao and ssao on display: view 'module00' is of a light-field display's module"),
            std::string::npos)
      << result.out;
  for (const char* technique : {"lightfield-hbao+", "lightfield-ssao"}) {
    const Json measured = row("display", technique);
    ASSERT_TRUE(measured.is_object()) << technique;
    EXPECT_EQ(measured["kind"], "display");
    EXPECT_GT(measured["ratio_to_hbao_plus"], 0) << technique;
    EXPECT_GT(measured["rmse_to_truth"], 0) << technique;
  }
  EXPECT_TRUE(row("display", "gtao").is_null());
  EXPECT_TRUE(row("corner", "gtao").is_object());
}

TEST_F(BenchSet, RefusesFlagsThatSayWhatASetSays) {
  for (const Arguments& more : {Arguments{"--scenes", "plane"}, {"--radius", "1"}, {"--fov", "60"}}) {
    const Result result = bench(more);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(more[0]), std::string::npos) << result.err;
  }
}

TEST_F(BenchSet, RowsOfAnEarlierResultAreMeasuredAgain) {
  ASSERT_EQ(bench({"--techniques", "hbao+,gtao", "--items", "room,walk,pair"}).status, 0);
  Json before = document();
  for (Json& each : before["results"])
    if (each["technique"] == "gtao" && each["scene"] == "room")
      each["rmse_to_truth"] = 0.9 * double(each["rmse_to_truth"]);
  const auto is_left_out = [](const Json& each) { return each["technique"] == "gtao" && each["scene"] == "pair"; };
  Json& results = before["results"];
  results.erase(std::remove_if(results.begin(), results.end(), is_left_out), results.end());
  std::ofstream(path("before.json")) << before.dump();
  const auto after = [&](const Arguments& more) {
    Arguments arguments = {"bench", "-o", path("after"), "--baseline", path("before.json"), "--regression", "error"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  };
  const Result worse = after({"--set", path("set"), "--json", path("figures.json")});
  EXPECT_EQ(worse.status, 1) << worse.out;
  EXPECT_NE(worse.err.find("1 row farther (gtao low on room)"), std::string::npos) << worse.err;
  const auto names = [](const Json& document) {
    std::set<std::string> all;
    for (const Json& each : document["results"])
      all.insert(std::string(each["scene"]) + " " + std::string(each["technique"]) + " " + std::string(each["preset"]));
    return all;
  };
  EXPECT_EQ(names(document("after")), names(before));
  EXPECT_EQ(Json::parse(slurp(path("figures.json")))["comparison"]["rows"].size(), results.size());
  const Result elsewhere = after({});
  EXPECT_EQ(elsewhere.status, 1);
  EXPECT_NE(elsewhere.err.find("is of the set test-1, whose frames are files; --set DIR says where"), std::string::npos)
      << elsewhere.err;
}

}  // namespace
}  // namespace gloam::test::bench_set_test
