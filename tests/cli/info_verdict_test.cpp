// The first sentence of gloam info, and its lines of what can run.
#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::info_verdict_test {
namespace {

class Info : public Cli {
 protected:
  std::string said(const fs::path& file, const Arguments& more = {}) const {
    Arguments arguments = {"info", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }
  std::string verdict(const fs::path& file, const Arguments& more = {}) const {
    const std::string text = said(file, more);
    return text.substr(0, text.find('\n'));
  }
};

TEST_F(Info, BeginsWithTheVerdict) {
  EXPECT_EQ(
      verdict(loggia),
      "Ambient occlusion can be computed: from depth and normals, by the camera in its header, within a radius of "
      "0.39 scene units: gloam ao " +
          loggia);
  EXPECT_NE(verdict(loggia, {"--fov", "60"}).find("by the camera that was given"), std::string::npos);
  EXPECT_TRUE(verdict(loggia, {"--fov", "60"}).ends_with(": gloam ao " + loggia + " --fov 60"));
  write_frame(path("depth.exr"), small_frame());
  EXPECT_NE(verdict(path("depth.exr")).find("from depth, of which normals are made, "), std::string::npos);
  Frame blind = small_frame();
  blind.views[0].camera.reset();
  write_frame(path("blind.exr"), blind);
  EXPECT_NE(verdict(path("blind.exr")).find("by a camera that is a guess (60 degrees wide)"), std::string::npos);
  write_frame(path("beauty.exr"), small_frame(32, 24, {"color"}));
  EXPECT_EQ(verdict(path("beauty.exr")), "Ambient occlusion cannot be computed: the file lacks depth.");
}

TEST_F(Info, BeginsWithTheVerdictOnAShot) {
  for (const int number : {1, 2, 3}) fs::copy_file(loggia, path(fmt::format("shot.{:04}.exr", number)));
  const std::string shot = path("shot.####.exr"), out = path("ao_shot.####.exr");
  EXPECT_EQ(verdict(shot),
            "Ambient occlusion can be computed of all 3 frames: from depth and normals, each by the camera in "
            "its header: gloam ao '" +
                shot + "' -o '" + out + "'");
  EXPECT_TRUE(verdict(shot, {"--frames", "1,3", "--fov", "60"})
                  .ends_with("each by the camera that was given: gloam ao '" + shot + "' -o '" + out +
                             "' --frames 1,3 --fov 60"));
  write_frame(path("shot.0002.exr"), small_frame(32, 24, {"color"}));
  EXPECT_NE(
      verdict(shot).find("of 2 of 3 frames: from depth and normals, each by the camera in its header; not of 2: the "
                         "files lack depth: gloam ao "),
      std::string::npos)
      << verdict(shot);
  EXPECT_EQ(verdict(path("shot.####.exr"), {"--frames", "2"}),
            "Ambient occlusion cannot be computed of any frame: the files lack depth.");
}

/// A channel of any name may be the depth: the hint is a flag that works.
TEST_F(Info, OneChannelOfAnUnknownNameMayBeTheDepth) {
  Frame frame = small_frame();
  frame.views[0].camera.reset();
  write_frame(path("frame.exr"), frame);
  FrameFile depth(path("frame.exr"), {.as_stored = true, .channels = {{"mask", "Z"}, {"depth", "none"}}});
  Frame odd = depth.read({"mask"});
  odd.views[0].planes["thing"] = std::move(odd.views[0].planes.at("mask"));
  odd.views[0].planes["thing"].name = "thing";
  odd.views[0].planes.erase("mask");
  write_frame(path("odd.exr"), odd);
  const std::string hint = "--plane depth=thing takes its only channel for the depth";
  EXPECT_EQ(verdict(path("odd.exr")), "Ambient occlusion cannot be computed: the file lacks depth; " + hint + ".");
  const Result refused = gloam({"ao", path("odd.exr")});
  EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
  EXPECT_NE(refused.err.find(hint), std::string::npos) << refused.err;
  EXPECT_EQ(gloam({"ao", path("odd.exr"), "--plane", "depth=thing"}).status, 0);
}

/// What the verdict says is what the command then does.
TEST_F(Info, TheCommandOfTheVerdictRunsWithTheRadiusThatItNames) {
  fs::copy_file(loggia, path("frame.exr"));
  const std::string sentence = verdict(path("frame.exr"));
  EXPECT_TRUE(sentence.ends_with(": gloam ao " + path("frame.exr").string())) << sentence;
  const Result ao = gloam({"ao", path("frame.exr")});
  ASSERT_EQ(ao.status, 0) << ao.err;
  EXPECT_NE(ao.out.find("radius 0.39 scene units"), std::string::npos) << ao.out;
}

TEST_F(Info, AResultOfGloamsOwnHasNothingUnread) {
  fs::copy_file(loggia, path("frame.exr"));
  ASSERT_EQ(gloam({"ao", path("frame.exr")}).status, 0);
  const fs::path result = path("frame_ao.exr");
  EXPECT_EQ(said(result).find("not read"), std::string::npos) << said(result);
  EXPECT_EQ(gloam({"info", result, "--json", "-"}).json()["unread"], nlohmann::json::array());
  EXPECT_EQ(verdict(result), "Ambient occlusion is in this file, and cannot be computed anew: the file lacks depth.");
}

TEST_F(Info, WhatRunsHasALineForEachKind) {
  const std::string text = said(loggia);
  EXPECT_NE(text.find("runs   ambient occlusion: alchemy, bitmask, evidence, gtao, "), std::string::npos) << text;
  EXPECT_NE(text.find("\n       masks, for --only: contact-mask, corner-mask"), std::string::npos) << text;
  const nlohmann::json runs = gloam({"info", loggia, "--json", "-"}).json()["runs"];
  for (const std::string name : runs)
    EXPECT_TRUE(text.find(" " + name + ",") != std::string::npos || text.find(" " + name + "\n") != std::string::npos)
        << name;
}

}  // namespace
}  // namespace gloam::test::info_verdict_test
