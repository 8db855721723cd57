// gloam bench --paper.
#include <filesystem>
#include <fstream>
#include <map>

#include "gloam_process.h"

namespace gloam::test {
namespace {

using Json = nlohmann::json;

TEST_F(Cli, APaperIsMeasuredAgain) {
  const Result result = gloam(
      {"bench", "--paper", "vermeer2021", "-o", path("paper"), "--size", "64x36", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(document, Json::parse(std::ifstream(path("paper/bench.json"))));
  std::map<std::string, int> tables;
  double paper_ratio = 0;
  for (const Json& row : document["paper"]) {
    ++tables[row["table"].get<std::string>().substr(0, 7)];
    EXPECT_GT(row["ms"], 0) << row;
    if (row["column"] == "HBAO+" && row["row"] == "4 samples") paper_ratio = row["paper_ratio"];
  }
  EXPECT_EQ(tables.size(), 3);
  EXPECT_NEAR(paper_ratio, 1.978 / 0.694, 1e-9);
  // More samples leave less of the gap, on every scene.
  std::map<std::string, double> left;
  for (const Json& fact : document["facts"]) {
    const std::string column = fact["column"], scene = fact["row"], name = fact["figure"];
    if (name.rfind("Error to all layers", 0) != 0) continue;
    if (column != "regular" && column.find("sample") == std::string::npos) continue;
    if (left.count(scene)) {
      EXPECT_LT(fact["value"], left[scene]) << scene << ", " << column;
    }
    left[scene] = fact["value"];
  }
  EXPECT_EQ(left.size(), 5);
  EXPECT_FALSE(document["pictures"].empty());
  for (const Json& picture : document["pictures"])
    EXPECT_TRUE(std::filesystem::exists(path("paper") / picture["file"].get<std::string>())) << picture;
  EXPECT_TRUE(std::filesystem::exists(path("paper/vermeer2021.md")));
}

TEST_F(Cli, OnlyPapersThatAreKnown) {
  const Result unknown = gloam({"bench", "--paper", "vermer2021", "-o", path("paper")});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("did you mean 'vermeer2021'?"), std::string::npos) << unknown.err;
  const Result both = gloam({"bench", "--paper", "vermeer2021", "-o", path("paper"), "--techniques", "hbao"});
  EXPECT_EQ(both.status, 2);
  EXPECT_EQ(both.lines_of_error(), 1) << both.err;
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace gloam::test
