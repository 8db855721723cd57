// gloam auto --composite and gloam reference composite: the same picture of measured and of traced parts.
#include <bit>

#include "cli/shot_fixture.h"
#include "gloam/composition.h"

namespace gloam::test::whole_picture_test {
namespace {

class WholePicture : public ShotTest {
 protected:
  void make_frame(const std::string& name,
                  const std::string& planes = "normal,color,ambient,albedo,metallic,roughness,reflectance") const {
    ASSERT_EQ(gloam({"capture", "gallery", "-o", file(name), "--size", "96x54", "--planes", planes}).status, 0);
  }
  Frame stored(const std::string& name, const std::vector<std::string>& planes) const {
    return FrameFile(path(name), {.as_stored = true}).read(planes);
  }
  Result automatic(const Arguments& more) const {
    Arguments all = {"auto", file("f.exr"), "-o", file("out.exr"), "--mask", "never", "--float", "--keep-depth"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
  /// The frame's colour, composed with planes of another file.
  Frame composed(const std::string& frame, const std::string& parts, const ComposeOptions& options = {}) const {
    Frame colour = stored(frame, planes_to_compose());
    compose(colour, stored(parts, part_planes()), options);
    keep_planes(colour, {"color"});
    return colour;
  }
  double error_of_colour(const std::string& name, const std::string& truth, const char* figure) const {
    return gloam({"compare", file(name), file(truth), "--plane", "color", "--json", "-"}).json()[figure];
  }
};

TEST_F(WholePicture, IsColourWithAllEffects) {
  make_frame("f.exr");
  const Result result = automatic({"--composite", file("c.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(same_bits(composed("f.exr", "out.exr"), stored("c.exr", {"color"})));
  EXPECT_FALSE(same_bits(stored("f.exr", {"color"}), stored("c.exr", {"color"})));
  std::vector<std::string> used;
  const nlohmann::json document = result.json();
  for (const auto& part : document["composite"]) {
    EXPECT_NE(part["how"], "");
    if (part["used"]) used.push_back(part["plane"]);
  }
  EXPECT_TRUE(std::find(used.begin(), used.end(), "ao") != used.end());
  EXPECT_TRUE(std::find(used.begin(), used.end(), "reflection") != used.end());
  const FrameFile made(path("c.exr"), {});
  const ColorHolds holds = parse_color_holds(made.text_attribute("gloamColorHolds"), "c.exr");
  EXPECT_TRUE(holds.ao && holds.reflection && holds.ambient && holds.shadows);
  EXPECT_EQ(made.text_attribute("gloamComposite").find("ao "), 0u);
  EXPECT_EQ(made.all_channels(), (std::vector<std::string>{"B", "G", "R"}));
}

TEST_F(WholePicture, NeedsNoOtherOutput) {
  make_frame("f.exr");
  ASSERT_EQ(automatic({"--composite", file("c.exr")}).status, 0);
  const Result alone = gloam({"auto", file("f.exr"), "--composite", file("alone.exr"), "--mask", "never"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_TRUE(same_bits(stored("alone.exr", {"color"}), stored("c.exr", {"color"})));
  fs::copy_file(path("f.exr"), path(numbered("s", 1)));
  ASSERT_EQ(gloam({"auto", file("s.####.exr"), "--composite", file("p.####.exr")}).status, 0);
  EXPECT_TRUE(fs::exists(path(numbered("p", 1))));
  EXPECT_EQ(files(), (std::vector<std::string>{"alone.exr", "c.exr", "f.exr", "out.exr", "p.0001.exr", "s.0001.exr"}));
  expect_refused({"auto", file("s.####.exr")}, 2, {"the results of a shot have no name", "-o 'auto.####.exr'"});
  expect_refused({"auto", file("f.exr"), "--composite", file("x.exr"), "--half"}, 2, {"--half", "-o"});
}

TEST_F(WholePicture, WhatColourHoldsAddsNothing) {
  make_frame("f.exr");
  const Result result =
      automatic({"--composite", file("c.exr"), "--color-holds", "ambient,shadows,ao,indirect,reflection"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(same_bits(stored("f.exr", {"color"}), stored("c.exr", {"color"})));
  EXPECT_NE(result.out.find("the colour holds reflections already"), std::string::npos) << result.out;
}

// A picture says what it holds, so that nothing is laid over it twice.
TEST_F(WholePicture, OfGloamRunSaysWhatItHolds) {
  make_frame("f.exr");
  ASSERT_EQ(gloam({"run", "ao", file("f.exr"), "--composite", file("c.exr")}).status, 0);
  EXPECT_EQ(FrameFile(path("c.exr"), {}).text_attribute("gloamColorHolds"), "ambient,shadows,ao");
  ASSERT_EQ(gloam({"run", "sssr", file("f.exr"), "--composite", file("c.exr")}).status, 0);
  EXPECT_EQ(FrameFile(path("c.exr"), {}).text_attribute("gloamColorHolds"), "ambient,shadows,reflection");
}

TEST_F(WholePicture, AmbientLightOfAFlag) {
  make_frame("f.exr", "normal,color,albedo");
  const Result plain = automatic({"--composite", file("plain.exr")});
  ASSERT_EQ(plain.status, 0) << plain.err;
  EXPECT_NE(plain.err.find("ambient occlusion darkens all of its colour"), std::string::npos) << plain.err;
  ASSERT_EQ(automatic({"--composite", file("c.exr"), "--ambient", "0.2,0.3,0.4"}).status, 0);
  ComposeOptions options;
  options.ambient = {0.2, 0.3, 0.4};
  EXPECT_TRUE(same_bits(composed("f.exr", "out.exr", options), stored("c.exr", {"color"})));
  EXPECT_FALSE(same_bits(stored("plain.exr", {"color"}), stored("c.exr", {"color"})));
}

TEST_F(WholePicture, HasAnErrorAgainstItsTruth) {
  make_frame("f.exr");
  ASSERT_EQ(automatic({"--composite", file("c.exr")}).status, 0);
  const Result traced =
      gloam({"reference", "composite", file("f.exr"), "-o", file("t.exr"), "--samples", "64", "--json", "-"});
  ASSERT_EQ(traced.status, 0) << traced.err;
  EXPECT_GT(traced.json()["noise"], 0.0);
  EXPECT_TRUE(same_bits(composed("f.exr", "t.exr"), stored("t.exr", {"color"})));
  EXPECT_TRUE(fs::exists(path("t.exr")) && !fs::exists(path("t.exr.partial.ao")));
  for (const char* figure : {"rmse", "flip"}) {
    const double with_effects = error_of_colour("c.exr", "t.exr", figure);
    EXPECT_GT(with_effects, 0) << figure;
    EXPECT_LT(with_effects, error_of_colour("f.exr", "t.exr", figure)) << figure;
  }
}

TEST_F(WholePicture, TruthUnderAnotherLightOrAnotherColourIsAnother) {
  make_frame("f.exr");
  ASSERT_EQ(gloam({"capture", "plane", "-o", file("sky.exr"), "--size", "64x32", "--planes", "color"}).status, 0);
  const auto truth = [&](const char* out, const Arguments& more) {
    Arguments all = {"reference", "composite", file("f.exr"), "-o", file(out), "--samples", "32"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  };
  ASSERT_EQ(truth("t.exr", {"--environment", file("sky.exr")}).status, 0);
  FrameFile made(path("t.exr"), {});
  EXPECT_TRUE(made.why_missing("environment").empty());
  EXPECT_EQ(made.text_attribute("gloamComposite").find("indirect reflection environment"), 0u)
      << made.text_attribute("gloamComposite");
  ASSERT_EQ(truth("all.exr", {"--color-holds", "ambient,shadows,ao,indirect,reflection"}).status, 0);
  EXPECT_TRUE(same_bits(stored("f.exr", {"color"}), stored("all.exr", {"color"})));
  expect_refused({"reference", "ao", file("f.exr"), "-o", file("t.exr"), "--color-holds", "none"}, 2,
                 {"--color-holds none", "composite"});
  expect_refused({"reference", "composite", file("f.exr"), "-o", file("t.exr"), "--environment-turn", "3"}, 2,
                 {"--environment-turn", "--environment FILE.exr"});
}

TEST_F(WholePicture, OfAShot) {
  for (const int number : {1, 2}) make_frame(numbered("shot", number));
  const auto shot = [&](const Arguments& more) {
    Arguments all = {"auto",        file("shot.####.exr"), "-o", file("o.####.exr"), "--float",
                     "--composite", file("c.####.exr")};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  };
  const Result made = shot({});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("composite: ao darkens ambient light"), std::string::npos) << made.err;
  for (const int number : {1, 2})
    EXPECT_TRUE(
        same_bits(composed(numbered("shot", number), numbered("o", number)), stored(numbered("c", number), {"color"})));
  fs::remove(path("c.0002.exr"));
  EXPECT_EQ(lines_of(shot({"--resume", "--json", "-"}).out).back()["skipped"], 1);
  EXPECT_TRUE(fs::exists(path("c.0002.exr")));
  expect_refused({"auto", file("shot.####.exr"), "-o", file("o.####.exr"), "--composite", file("c.exr")}, 2,
                 {"--composite", "is one file"});
}

TEST_F(WholePicture, RefusesInOneLine) {
  make_frame("f.exr", "normal,color");
  write_frame(path("depth.exr"), small_frame(64, 48, {"depth", "normal"}));
  const std::string out = file("o.exr"), c = file("c.exr");
  const auto with = [&](const char* frame, const Arguments& more) {
    Arguments all = {"auto", file(frame), "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused(with("depth.exr", {"--composite", c}), 1,
                 {"--composite", "no channel is known as the frame's colour",
                  "fall away too: light of near surfaces and reflections"});
  expect_refused(with("f.exr", {"--composite", c, "--ambient", "1,1,1"}), 2, {"--ambient 1,1,1", "no 'albedo'"});
  expect_refused(with("f.exr", {"--composite", c, "--ambient", "1,1"}), 2, {"--ambient 1,1", "three numbers"});
  expect_refused(with("f.exr", {"--composite", c, "--ambient", "1,1,-1"}), 2, {"--ambient", "-1"});
  expect_refused(with("f.exr", {"--composite", c, "--color-holds", "sun"}), 2,
                 {"--color-holds sun", "ambient, shadows"});
  expect_refused(with("depth.exr", {"--color-holds", "none"}), 2, {"--color-holds", "has no colour"});
  expect_refused(with("depth.exr", {"--ambient", "1,1,1"}), 2, {"--ambient", "has no colour"});
  expect_refused(with("f.exr", {"--composite", out}), 2, {"--composite", "is also -o"});
  expect_refused(with("f.exr", {"--composite", file("f.exr")}), 2, {"--composite", "is also the frame"});
  expect_refused(with("f.exr", {"--composite", file("c.jpg")}), 2, {"--composite", ".exr"});
  expect_refused(with("f.exr", {"--composite", file("c.####.exr")}), 2, {"--composite", "is a pattern"});
  make_frame("normals.exr", "normal");
  expect_refused({"reference", "composite", file("normals.exr"), "-o", out}, 1, {"reference composite", "no 'color'"});
}

}  // namespace
}  // namespace gloam::test::whole_picture_test
