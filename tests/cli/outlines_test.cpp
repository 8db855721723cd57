// gloam capture --outlines, as a user runs it.
#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::outlines_test {
namespace {

class OutlineCapture : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  Frame counts(const std::string& name) const { return FrameFile(file(name), {}).read({"depth", "outline_count"}); }

  static float count_at(const Frame& frame, size_t view, int x, int y) {
    return frame.views[view].planes.at("outline_count").channels[0].at(x, y);
  }

  /// Expects a usage error of one line that contains `says`, and no files.
  void expect_refused(const Arguments& flags, const std::string& says) const {
    Arguments arguments = {"capture", "pillar", "-o", file("f.exr"), "--size", "64x36"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_TRUE(files().empty());
  }
};

TEST_F(OutlineCapture, IsAPlaneAndSaysHowItWasMade) {
  const Result result = gloam({"capture", "statue", "--faces", "5000", "-o", file("f.exr"), "--size", "64x36",
                               "--planes", "normal", "--outlines", "0.25", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json outlines = result.json()["outlines"];
  EXPECT_EQ(outlines["extent"], 0.25);
  EXPECT_EQ(outlines["method"], "mitre");
  EXPECT_EQ(outlines["angle"], 1);
  EXPECT_EQ(outlines["triangles_of_scene"], result.json()["faces"]);
  EXPECT_EQ(outlines["triangles"], outlines["triangles_of_scene"]);
  EXPECT_GT(outlines["ms"]["build"], 0);
  EXPECT_GT(outlines["ms"]["count"], 0);
  EXPECT_LT(outlines["ms"]["count"], 1e3 * double(result.json()["seconds"]["trace"])) << "a part of it";
  FrameFile frame(file("f.exr"), {});
  EXPECT_EQ(frame.common_planes(), (std::vector<std::string>{"depth", "normal", "outline_count"}));
  EXPECT_EQ(frame.number_attribute("gloamOutlines"), 0.25);
  EXPECT_EQ(frame.text_attribute("gloamOutlineMethod"), "mitre");
  EXPECT_EQ(frame.number_attribute("gloamOutlineAngle"), 1);
  const Frame read = counts("f.exr");
  int in_two = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) in_two += count_at(read, 0, x, y) >= 2;
  }
  EXPECT_GT(in_two, 100) << "where things are near each other";
  EXPECT_LT(in_two, 64 * 36);
}

TEST_F(OutlineCapture, NoneUnlessAskedFor) {
  const Result result = gloam({"capture", "pillar", "-o", file("f.exr"), "--size", "64x36", "--json", "-"});
  EXPECT_EQ(result.json()["outlines"], nullptr);
  const std::vector<std::string> planes = FrameFile(file("f.exr"), {}).common_planes();
  EXPECT_TRUE(std::find(planes.begin(), planes.end(), "outline_count") == planes.end());
}

/// A box of 2 x 1 x 1 half extents, in a file: the extent of its outline tells the methods apart.
TEST_F(OutlineCapture, MethodsOnAMeshFile) {
  std::ofstream(path("box.obj"))
      << "v -2 -1 -1\nv 2 -1 -1\nv 2 1 -1\nv -2 1 -1\nv -2 -1 1\nv 2 -1 1\nv 2 1 1\nv -2 1 1\n"
         "o box\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"
         "v -2 1.3 -1\nv 2 1.3 -1\nv 2 1.3 1\nv -2 1.3 1\n"
         "o lid\nf 9 12 11 10\n";
  // The underside of a lid 0.3 above the box faces down: it is in the box's outline if that is thicker. (The lid's other side
  // faces up, so that its own outline is not met.) With method normal the ray enters where faces have come apart: it is in the
  // outline, but does not count.
  const std::vector<std::tuple<std::string, std::string, float>> expected = {
      {"mitre", "0.25", 0},  {"mitre", "0.35", 1},  {"integrated", "0.5", 0}, {"integrated", "0.6", 1},
      {"scaling", "0.5", 0}, {"scaling", "0.7", 1}, {"normal", "0.2", 0},     {"normal", "0.4", 0}};
  for (const auto& [method, extent, count] : expected) {
    ASSERT_EQ(
        gloam({"capture", file("box.obj"), "-o", file("f.exr"), "--size", "33x33", "--planes", "depth", "--eye",
               "0,1.15,3", "--target", "0,1.3,0", "--fov", "20", "--outlines", extent, "--outline-method", method})
            .status,
        0);
    EXPECT_EQ(FrameFile(file("f.exr"), {}).text_attribute("gloamOutlineMethod"), method);
    EXPECT_EQ(count_at(counts("f.exr"), 0, 16, 16), count) << method << " by " << extent;
  }
}

TEST_F(OutlineCapture, EveryViewHasItsCounts) {
  for (const Arguments& more : {Arguments{"--view2", "30"}, Arguments{"--stereo", "0.2"}}) {
    Arguments arguments = {"capture", "courtyard", "-o",    file("f.exr"), "--size",
                           "64x36",   "--planes",  "depth", "--outlines",  "0.2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(gloam(arguments).status, 0);
    const Frame frame = counts("f.exr");
    ASSERT_EQ(frame.views.size(), 2u);
    int differing = 0;
    for (size_t view = 0; view < 2; ++view) {
      int counted = 0;
      for (int y = 0; y < 36; ++y) {
        for (int x = 0; x < 64; ++x) {
          counted += count_at(frame, view, x, y) > 0;
          differing += count_at(frame, 0, x, y) != count_at(frame, 1, x, y);
        }
      }
      EXPECT_GT(counted, 64 * 36 / 2) << frame.views[view].name;
    }
    EXPECT_GT(differing, 50) << "seen from elsewhere";
  }
}

TEST_F(OutlineCapture, BadFlags) {
  for (const char* extent : {"0", "-1", "inf", "nan", "wide", "1e16", "0.5m"})
    expect_refused({"--outlines", extent}, std::string("--outlines ") + extent + " is not allowed; a number from ");
  expect_refused({"--outlines", "1", "--outline-method", "integrate"},
                 "(did you mean 'integrated'?); mitre, integrated, scaling");
  expect_refused({"--outlines", "1", "--outline-angle", "91"}, "a number from 0 to 90 is");
  expect_refused({"--outline-method", "scaling"}, "--outlines EXTENT");
  expect_refused({"--outline-angle", "2"}, "--outlines EXTENT");
  expect_refused({"--outlines", "1", "--outline-method", "normal", "--outline-angle", "2"}, "leave it out");
}

TEST_F(OutlineCapture, HelpHasTheFlagsAndAnExample) {
  const std::string help = gloam({"capture", "--help"}).out;
  for (const char* text : {"--outlines EXTENT", "--outline-method mitre|integrated|scaling|normal",
                           "--outline-angle DEGREES", "gloam capture courtyard -o courtyard.exr --outlines 0.5"})
    EXPECT_NE(help.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace gloam::test::outlines_test
