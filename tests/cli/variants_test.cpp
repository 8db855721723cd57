// --layers and --eyes choose variants of methods.
#include "cli/gloam_process.h"
#include "gloam/planes.h"
#include "gloam/technique.h"
#include "support/stress.h"

namespace gloam::test {
namespace {

using Json = nlohmann::json;
using Variants = Cli;

TEST_F(Variants, LayersChooseTheRowThatANameHas) {
  Frame frame = shoot(perspective(48, 32), room());
  for (const char* layer : {"peel.00", "peel.01"}) invent_plane(frame, layer);
  write_frame(path("frame.exr"), frame);
  const std::string file = path("frame.exr").string();
  const Result named = gloam({"run", "dp-gtao", file, "-o", path("named.exr"), "--radius", "0.5"});
  ASSERT_EQ(named.status, 0) << named.err;
  const Result chosen =
      gloam({"run", "gtao", file, "--layers", "peeled", "-o", path("chosen.exr"), "--radius", "0.5", "--json", "-"});
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  EXPECT_EQ(chosen.json().at("technique"), "dp-gtao");
  EXPECT_EQ(slurp(path("named.exr")), slurp(path("chosen.exr")));
  for (const char* same : {"dp-gtao", "gtao"})
    EXPECT_EQ(gloam({"plan", same, file, "--layers", "peeled", "--json", "-"}).json(),
              gloam({"plan", "dp-gtao", file, "--json", "-"}).json());
  EXPECT_EQ(gloam({"plan", "ao", file, "--layers", "peeled", "--json", "-"}).json().at("passes").at(0).at("name"),
            "dp-evidence/estimate");
}

TEST_F(Variants, AShareOfSamplesIsOfNoUseWhereNothingIsDrawn) {
  Frame frame = shoot(perspective(48, 32), room());
  for (const char* layer : {"peel.00", "peel.01"}) invent_plane(frame, layer);
  write_frame(path("frame.exr"), frame);
  const auto notes = [&](const Arguments& settings) {
    Arguments arguments = {"run", "sd-hbao", path("frame.exr"), "-o", path("ao.exr"), "--radius", "0.5"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  const std::string words = "stochastic-depth: alpha 0.4 changes nothing";
  EXPECT_NE(notes({"--set", "stochastic-depth.alpha=0.4"}).find(words), std::string::npos);
  EXPECT_EQ(notes({"--set", "stochastic-depth.alpha=0.4", "--set", "stochastic-depth.subset=stratified"}).find(words),
            std::string::npos);
  EXPECT_EQ(notes({}).find(words), std::string::npos);
}

TEST_F(Variants, ThatNoTechniqueOfAnEffectHasAreRefusedInOneLine) {
  Frame frame = shoot(perspective(48, 32), room());
  invent_plane(frame, "contact");
  write_frame(path("frame.exr"), frame);
  const std::string file = path("frame.exr").string();
  const std::string words =
      "--layers peeled: no technique that makes contact has this variant; there are contact-shadow";
  for (const Arguments& arguments :
       {Arguments{"pick", file, "--truth", file, "--budget", "20ms", "--layers", "peeled"},
        Arguments{"bench", "-o", path("out").string(), "--effects", "contact", "--layers", "peeled"}}) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.err, "gloam: " + words + "\n");
  }
}

TEST_F(Variants, OfEveryRowAreFoundByItsMethodAndFlags) {
  const Json rows = gloam({"list", "techniques", "--json", "-"}).json();
  EXPECT_EQ(rows.size(), registry().size());
  int variants = 0;
  for (const Json& row : rows) {
    const Json& variant = row.at("variant");
    if (variant.is_null()) continue;
    ++variants;
    const std::string name = row.at("name"), of = variant.at("of");
    // A frame without planes: what is missing is named by the row.
    write_frame(path("empty.exr"), small_frame(8, 8, {"color"}));
    const Result refused =
        gloam({"plan", of, path("empty.exr"), "--layers", variant.at("layers"), "--eyes", variant.at("eyes")});
    EXPECT_NE(refused.err.find(name + ": needs"), std::string::npos) << name << ": " << refused.err;
  }
  EXPECT_GT(variants, 20);
}

TEST_F(Variants, ThatDoNotExistAreRefusedWithThoseThatDo) {
  write_frame(path("f.exr"), small_frame(8, 8, {"depth"}));
  const auto said = [&](Arguments words) {
    words.insert(words.begin(), "plan");
    words.insert(words.begin() + 2, path("f.exr"));
    const Result refused = gloam(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
    return refused.err;
  };
  EXPECT_EQ(said({"hbao+", "--layers", "peeled", "--eyes", "both"}),
            "gloam: hbao+: has no variant --layers peeled --eyes both; there are hbao+, dp-hbao+ (--layers peeled), "
            "sd-hbao+ (--layers stochastic), stereo-ao (--eyes both) and stereo-sd-hbao+ (--layers stochastic --eyes "
            "both)\n");
  EXPECT_EQ(said({"normals", "--eyes", "both"}),
            "gloam: normals: has no variant --eyes both, nor any other; leave that out\n");
  EXPECT_EQ(said({"sd-gtao", "--layers", "one"}),
            "gloam: sd-gtao: is gtao with --layers stochastic, which --layers one contradicts; leave that out, or name "
            "gtao\n");
  EXPECT_EQ(
      said({"stereo-gtao", "--eyes", "one"}),
      "gloam: stereo-gtao: is gtao with --eyes both, which --eyes one contradicts; leave that out, or name gtao\n");
  EXPECT_NE(said({"gtao", "--layers", "peel"})
                .find("--layers peel is not allowed (did you mean 'peeled'?); one, "
                      "stochastic and peeled are"),
            std::string::npos);
}

TEST_F(Variants, StandInTheLinesOfTheirMethods) {
  const std::string list = gloam({"list", "techniques"}).out, one = gloam({"list", "techniques", "hbao+"}).out;
  const size_t at = list.find("\n  hbao+ ");
  ASSERT_NE(at, std::string::npos);
  const std::string line = list.substr(at + 1, list.find('\n', at + 1) - at - 1);
  EXPECT_NE(line.find("[--layers stochastic peeled; --eyes both both+stochastic]"), std::string::npos) << line;
  EXPECT_EQ(list.find("\n  sd-"), std::string::npos);
  EXPECT_NE(one.find("--layers stochastic --eyes both: stereo-sd-hbao+"), std::string::npos) << one;
  EXPECT_NE(gloam({"list", "techniques", "dp-gtao"}).out.find("variant of gtao: --layers peeled"), std::string::npos);
}

TEST_F(Variants, AreCompleted) {
  const std::string bash = gloam({"completion", "bash"}).out;
  EXPECT_NE(bash.find("one stochastic peeled"), std::string::npos);
  EXPECT_NE(bash.find("one both"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test
