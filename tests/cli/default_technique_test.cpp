// `ao` stands for one technique everywhere: in run, plan, auto, the list, the README and the demo.
#include <regex>

#include "cli/gloam_process.h"

namespace gloam::test::default_technique_test {
namespace {

using Json = nlohmann::json;
using DefaultTechnique = Cli;

/// The technique of the first command of a text with this beginning.
std::string first_run_in(const std::string& text) {
  std::smatch found;
  return std::regex_search(text, found, std::regex("gloam\"? run ([a-z0-9+-]+)")) ? found[1].str() : "";
}

TEST_F(DefaultTechnique, IsTheSameEverywhere) {
  ASSERT_EQ(gloam({"run", "ao", loggia, "-o", path("ao.exr")}).status, 0);
  const std::string name = FrameFile(path("ao.exr"), {}).text_attribute("gloamTechnique");
  EXPECT_EQ(name, "evidence");
  EXPECT_EQ(gloam({"plan", "ao", loggia, "--json", "-"}).json().at("passes").at(0).at("name"), name + "/estimate");
  const Json automatic = gloam({"auto", loggia, "-o", path("auto.exr"), "--json", "-"}).json();
  EXPECT_EQ(automatic.at("effects").at(0).at("technique"), name);
  EXPECT_EQ(automatic.at("effects").at(0).at("runs"), name);
  int defaults = 0;
  for (const Json& technique : gloam({"list", "techniques", "--json", "-"}).json()) {
    const Json made = technique.value("default_for", Json::array());
    const bool is_default = std::find(made.begin(), made.end(), "ao_raw") != made.end();
    defaults += is_default;
    if (is_default) {
      EXPECT_EQ(technique.at("name"), name);
    }
  }
  EXPECT_EQ(defaults, 1);
  const fs::path root = GLOAM_SOURCE_DIR;
  EXPECT_EQ(first_run_in(slurp(root / "README.md")), "ao");
  EXPECT_EQ(first_run_in(slurp(root / "script/demo")), "ao");
}

TEST_F(DefaultTechnique, TakesTheFlagsOfTheTechnique) {
  ASSERT_EQ(gloam({"run", "ao", loggia, "-o", path("a.exr"), "--edge-factor", "2", "--preset", "low"}).status, 0);
  ASSERT_EQ(gloam({"run", "evidence", loggia, "-o", path("b.exr"), "--edge-factor", "2", "--preset", "low"}).status, 0);
  EXPECT_EQ(slurp(path("a.exr")), slurp(path("b.exr")));
}

TEST_F(DefaultTechnique, IsPlannedOverTimeAsItRuns) {
  const Arguments flags = {loggia, "--temporal", "--json", "-"};
  const auto with = [&](Arguments words) {
    words.insert(words.end(), flags.begin(), flags.end());
    return words;
  };
  const Result planned = gloam(with({"plan", "ao"}));
  ASSERT_EQ(planned.status, 0) << planned.err;
  EXPECT_EQ(planned.json().at("passes"), gloam(with({"plan", "evidence"})).json().at("passes"));
  const Json ran = gloam(with({"run", "ao", "-o", path("ao.exr").string()})).json();
  ASSERT_EQ(planned.json().at("passes").size(), ran.at("passes").size());
  for (size_t i = 0; i < ran.at("passes").size(); ++i)
    EXPECT_EQ(planned.json().at("passes")[i].at("name"), ran.at("passes")[i].at("name"));
}

}  // namespace
}  // namespace gloam::test::default_technique_test
