// A frame in two files: one eye each.
#include <glm/geometric.hpp>

#include "cli/gloam_process.h"
#include "gloam/planes.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::two_files_test {
namespace {

using glm::dvec3;

class TwoFiles : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  /// A pair of eyes, in one file.
  void capture_pair(const Arguments& more = {"--planes", "normal"}) const {
    Arguments all = {"capture", "fence", "-o", file("pair.exr"), "--size", "64x36", "--stereo", "0.2"};
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  Frame eye_of_pair(const std::string& view, const std::vector<std::string>& planes = {"depth", "normal"}) const {
    ReadOptions options;
    options.views = {view};
    return FrameFile(path("pair.exr"), options).read(planes);
  }

  /// One eye of the pair in a file of its own.
  void write_eye(const std::string& view, const std::string& to, const std::string& name,
                 const std::vector<std::string>& planes = {"depth", "normal"}) const {
    Frame frame = eye_of_pair(view, planes);
    frame.views[0].name = name;
    write_frame(path(to), frame);
  }

  void write_camera(const std::string& name, const std::string& body) const {
    std::ofstream(path(name)) << R"({"width": 64, "height": 36, "fx": 50, "fy": 50, "cx": 32, "cy": 18, )" << body
                              << "}";
  }

  Result run(const std::string& technique, const Arguments& frame, const std::string& out) const {
    Arguments all = {"run", technique, "--keep-depth"};
    all.insert(all.end(), frame.begin(), frame.end());
    // The radius is given, since one of the files may state another one than the frame would get.
    all.insert(all.end(), {"-o", file(out), "--radius", "0.5", "--json", "-"});
    return gloam(all);
  }

  void expect_refused(const Arguments& frame, int status, const std::vector<std::string>& says) const {
    const std::vector<std::string> before = files();
    const Result result = run("hbao+", frame, "out.exr");
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    for (const std::string& words : says) EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << "a refused command leaves nothing behind";
  }
};

std::string pose(double x) {
  return fmt::format(R"("camera_to_world": [[1,0,0,{}],[0,1,0,0],[0,0,1,4],[0,0,0,1]])", x);
}

/// `same_bits` compares only the first view.
void expect_same_in_all_views(const Frame& a, const Frame& b, const std::vector<std::string>& planes) {
  ASSERT_EQ(a.views.size(), b.views.size());
  for (size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_EQ(a.views[i].name, b.views[i].name);
    for (const std::string& plane : planes) {
      ASSERT_TRUE(a.views[i].find(plane) && b.views[i].find(plane)) << plane << " of " << a.views[i].name;
      EXPECT_EQ(difference(*a.views[i].find(plane), *b.views[i].find(plane)).max, 0)
          << plane << " of " << a.views[i].name;
    }
  }
}

TEST_F(TwoFiles, AreTheSameAsOneFileOfTwoViews) {
  capture_pair({"--planes", "normal", "--stochastic", "4"});
  const std::vector<std::string> planes = {"depth",         "normal",        "stochastic.00",
                                           "stochastic.01", "stochastic.02", "stochastic.03"};
  write_eye("left", "a_L.exr", "", planes);
  write_eye("right", "a_R.exr", "", planes);
  for (const char* technique : {"hbao+", "multiview"}) {
    ASSERT_EQ(run(technique, {file("pair.exr")}, "one.exr").status, 0);
    const Result result = run(technique, {file("a_L.exr"), file("a_R.exr")}, "two.exr");
    ASSERT_EQ(result.status, 0) << result.err;
    FrameFile one(path("one.exr"), {}), two(path("two.exr"), {});
    EXPECT_EQ(two.views(), one.views());
    expect_same_in_all_views(one.read({"ao", "depth"}), two.read({"ao", "depth"}), {"ao", "depth"});
    for (const std::string& view : one.views())
      EXPECT_EQ(two.camera(view)->pose->position, one.camera(view)->pose->position) << technique;
  }
  ASSERT_EQ(run("multiview", {file("a_R.exr"), file("a_L.exr")}, "swapped.exr").status, 0);
  Frame left = FrameFile(path("two.exr"), {}).read({"ao"}), right = FrameFile(path("swapped.exr"), {}).read({"ao"});
  EXPECT_EQ(right.views[0].name, "right") << "multiview works on the first";
  right.views[0].name = left.views[0].name;
  EXPECT_FALSE(same_bits(left, right));
}

TEST_F(TwoFiles, PlanNamesTheChannelsOfBoth) {
  capture_pair();
  write_eye("left", "a_L.exr", "");
  write_eye("right", "a_R.exr", "");
  const nlohmann::json decoded =
      gloam({"plan", "hbao+", file("a_L.exr"), file("a_R.exr"), "--json", "-"}).json()["decoded"];
  EXPECT_EQ(decoded[0], "a_L.exr: Z") << decoded;
  EXPECT_NE(std::find(decoded.begin(), decoded.end(), "a_R.exr: Z"), decoded.end()) << decoded;
}

struct NameCase {
  std::string left_view, right_view;  ///< names in the files
  std::string first, second;          ///< the files; the first one holds the left eye
  std::vector<std::string> views;
  std::string note;
};

TEST_F(TwoFiles, NamesOfTheEyes) {
  capture_pair();
  const std::vector<NameCase> cases = {
      {"port", "starboard", "x_L.exr", "x_R.exr", {"port", "starboard"}, ""},
      {"", "", "x_L.exr", "x_R.exr", {"left", "right"}, "'left' and x_R.exr as 'right', by their names"},
      {"", "", "x-right.0012.exr", "x-LEFT.0012.exr", {"right", "left"}, "by their names"},
      {"", "", "left.exr", "other.exr", {"left", "right"}, "by their names"},
      {"", "", "a.exr", "b.exr", {"left", "right"}, "in the order given"},
      {"", "", "toll.exr", "car.exr", {"left", "right"}, "in the order given"},
      {"", "", "a_L.exr", "b_L.exr", {"left", "right"}, "in the order given"},
      {"right", "", "a.exr", "b.exr", {"right", "left"}, "by their names"},
      {"left", "left", "a_R.exr", "b_L.exr", {"right", "left"}, "by their names"},
      {"left", "left", "a.exr", "b.exr", {"left", "right"}, "in the order given"},
  };
  for (const NameCase& test : cases) {
    SCOPED_TRACE(test.first + " " + test.second + ", views " + test.left_view + " " + test.right_view);
    write_eye("left", test.first, test.left_view);
    write_eye("right", test.second, test.right_view);
    const Result result = run("hbao+", {file(test.first), file(test.second)}, "out.exr");
    ASSERT_EQ(result.status, 0) << result.err;
    FrameFile out(path("out.exr"), {});
    EXPECT_EQ(out.views(), test.views);
    EXPECT_EQ(out.camera(test.views[0])->pose->position, eye_of_pair("left").views[0].camera->pose->position);
    EXPECT_EQ(out.camera(test.views[1])->pose->position, eye_of_pair("right").views[0].camera->pose->position);
    EXPECT_NE(result.err.find(test.note), std::string::npos) << result.err;
    EXPECT_EQ(result.err.empty(), test.note.empty()) << result.err;
    fs::remove(path(test.first));
    fs::remove(path(test.second));
  }
}

// One picture of a file that lists two views, as renderers write eye by eye: the pair tells which eye it is.
TEST_F(TwoFiles, AViewThatIsOnlyListed) {
  Frame frame = small_frame(64, 36);
  frame.views[0].camera.reset();
  frame.views[0].name = "left";
  View& second = frame.views.emplace_back();
  second.name = "right";
  write_frame(path("a_L.exr"), frame);
  write_frame(path("a_R.exr"), frame);
  write_camera("a.camera.json",
               R"("views": [{"view": "left", )" + pose(0) + R"(}, {"view": "right", )" + pose(1) + "}]");
  ASSERT_TRUE(FrameFile(path("a_R.exr"), {}).view_is_assumed());
  const Result result = run("hbao+", {file("a_L.exr"), file("a_R.exr")}, "out.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(FrameFile(path("out.exr"), {}).views(), (std::vector<std::string>{"left", "right"}));
  EXPECT_NE(result.err.find("taken for 'right'"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("the first that the file lists"), std::string::npos) << result.err;
}

TEST_F(TwoFiles, EachIsReadByItsOwnConventions) {
  capture_pair();
  write_eye("left", "a_L.exr", "");
  Frame right = eye_of_pair("right");
  write_frame(path("a_R.exr"), right);
  ASSERT_EQ(run("hbao+", {file("a_L.exr"), file("a_R.exr")}, "plain.exr").status, 0);
  Channel& depth = right.views[0].planes.at("depth").channels[0];
  for (int y = 0; y < right.height(); ++y)
    for (int x = 0; x < right.width(); ++x) depth.at(x, y) *= -1;
  write_frame(path("a_R.exr"), right);
  const Result result = run("hbao+", {file("a_L.exr"), file("a_R.exr")}, "negative.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("a_R.exr: depth:"), std::string::npos) << result.err;
  const Frame plain = FrameFile(path("plain.exr"), {}).read({"ao"});
  expect_same_in_all_views(plain, FrameFile(path("negative.exr"), {}).read({"ao"}), {"ao"});
  EXPECT_FALSE(is_background(
      FrameFile(path("negative.exr"), {}).read({"depth"}).view("right").planes.at("depth").channels[0].at(32, 30)));
}

TEST_F(TwoFiles, CamerasFromAJson) {
  for (const char* name : {"a_L.exr", "a_R.exr"}) {
    Frame frame = small_frame(64, 36);
    frame.views[0].camera.reset();
    write_frame(path(name), frame);
  }
  const Arguments eyes = {file("a_L.exr"), file("a_R.exr")};
  const auto expect_eyes_at = [&](const Arguments& frame, double left, double right) {
    const Result result = run("hbao+", frame, "out.exr");
    ASSERT_EQ(result.status, 0) << result.err;
    FrameFile out(path("out.exr"), {});
    EXPECT_NEAR(out.camera("left")->pose->position.x, left, 1e-9);
    EXPECT_NEAR(out.camera("right")->pose->position.x, right, 1e-9);
    EXPECT_NEAR(out.camera("right")->fx, 50, 1e-4);
    fs::remove(path("out.exr"));
  };
  const auto both = [](double left, double right) {
    return R"("views": [{"view": "left", )" + pose(left) + R"(}, {"view": "right", )" + pose(right) + "}]";
  };
  expect_refused(eyes, 1, {"a_L.exr: has no camera", "--camera FILE", "'left' and 'right'"});
  write_camera("given.json", both(1, 2));
  expect_eyes_at({file("a_L.exr"), file("a_R.exr"), "--camera", file("given.json")}, 1, 2);
  write_camera("a.camera.json", both(3, 4));
  expect_eyes_at(eyes, 3, 4);
  write_camera("a_L.camera.json", pose(5));
  write_camera("a_R.camera.json", pose(6));
  expect_eyes_at(eyes, 5, 6);
  fs::remove(path("a_L.camera.json"));
  fs::remove(path("a_R.camera.json"));
  write_camera("a.camera.json", pose(7));
  expect_refused(eyes, 1, {"a_L.exr: has no camera", "a.camera.json has one camera", "--camera FILE"});
  expect_refused({file("a_L.exr"), file("a_R.exr"), "--camera", file("a.camera.json")}, 1,
                 {"a.camera.json has one camera", "a_L.exr has the view left", "a camera for each"});
  write_camera("a.camera.json",
               R"("views": [{"view": "port", )" + pose(1) + R"(}, {"view": "starboard", )" + pose(2) + "}]");
  expect_refused({file("a_L.exr"), file("a_R.exr"), "--camera", file("a.camera.json")}, 1, {"port and starboard"});
}

TEST_F(TwoFiles, StacksOfDifferentDepth) {
  capture_pair({"--planes", "normal", "--peel", "4"});
  const std::vector<std::string> four = {"depth", "normal", "peel.00", "peel.01", "peel.02", "peel.03"},
                                 two = {"depth", "normal", "peel.00", "peel.01"};
  write_eye("left", "a_L.exr", "", four);
  write_eye("right", "a_R.exr", "", two);
  Frame in_one = eye_of_pair("left", four);
  in_one.views.push_back(std::move(eye_of_pair("right", two).views[0]));
  write_frame(path("one.exr"), in_one);
  ASSERT_EQ(run("dp-hbao+", {file("one.exr"), "--radius", "9"}, "of_one.exr").status, 0);
  const Result result = run("dp-hbao+", {file("a_L.exr"), file("a_R.exr"), "--radius", "9"}, "of_two.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  expect_same_in_all_views(FrameFile(path("of_one.exr"), {}).read({"ao"}),
                           FrameFile(path("of_two.exr"), {}).read({"ao"}), {"ao"});
  ASSERT_EQ(run("dp-hbao+", {file("pair.exr"), "--view", "left", "--radius", "9"}, "left.exr").status, 0);
  Frame left = FrameFile(path("left.exr"), {}).read({"ao"}), of_two = FrameFile(path("of_two.exr"), {}).read({"ao"});
  EXPECT_EQ(difference(left.views[0].planes.at("ao"), of_two.view("left").planes.at("ao")).max, 0)
      << "all four layers of the left eye count";
}

TEST_F(TwoFiles, APlaneThatOneLacksIsSaid) {
  capture_pair();
  write_eye("left", "a_L.exr", "");
  write_eye("right", "a_R.exr", "", {"depth"});
  const Result result = run("hbao+", {file("a_L.exr"), file("a_R.exr")}, "out.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("view 'right' has no normal"), std::string::npos) << result.err;
  EXPECT_EQ(result.json()["passes"][0]["name"], "normals/differences");
  fs::remove(path("out.exr"));
  write_eye("right", "a_R.exr", "", {"normal"});
  expect_refused({file("a_L.exr"), file("a_R.exr")}, 1, {"a_L.exr and a_R.exr", "view 'right' has no depth"});
}

TEST_F(TwoFiles, TheFrameCoversTheDataOfBoth) {
  Frame small = small_frame(32, 24), large = small_frame(36, 30);
  small.views[0].camera->pose = large.views[0].camera->pose = Pose{};
  large.display = small.display;
  large.window = {-2, -3, 34, 27};
  write_frame(path("a_L.exr"), small);
  write_frame(path("a_R.exr"), large);
  ASSERT_EQ(run("hbao+", {file("a_L.exr"), file("a_R.exr"), "--keep-margin"}, "out.exr").status, 0);
  FrameFile out(path("out.exr"), {});
  EXPECT_EQ(out.window(), (Window{-2, -3, 34, 27}));
  EXPECT_EQ(out.display(), (Window{0, 0, 32, 24}));
  const Frame frame = out.read({"depth"});
  EXPECT_TRUE(is_background(frame.views[0].planes.at("depth").channels[0].at(0, 0)));
  EXPECT_FALSE(is_background(frame.views[0].planes.at("depth").channels[0].at(2, 3)));
  EXPECT_FALSE(is_background(frame.views[1].planes.at("depth").channels[0].at(0, 0)));
}

TEST_F(TwoFiles, RefusesInOneLine) {
  capture_pair();
  write_eye("left", "a_L.exr", "");
  write_eye("right", "a_R.exr", "");
  const std::string left = file("a_L.exr"), right = file("a_R.exr");
  expect_refused({left, left}, 2, {"a_L.exr: is given twice"});
  expect_refused({left, (folder / "." / "a_L.exr").string()}, 2, {"is given twice"});
  expect_refused({left, file("pair.exr")}, 2, {"pair.exr: has the views 'left' and 'right'", "alone"});
  expect_refused({left, right, "--view", "left"}, 2, {"--view left"});
  expect_refused({left, right, "--views", "right,left"}, 2, {"--view right,left"});
  expect_refused({left, right, file("c.exr")}, 2, {"c.exr"});
  expect_refused({left, file("none.exr")}, 1, {"none.exr"});
  expect_refused({left, file("out.exr")}, 2, {"is also the frame"});
  write_frame(path("large.exr"), small_frame(65, 36));
  expect_refused({left, file("large.exr")}, 1, {"large.exr: shows 65x36", "64x36", "of one size"});
  Frame lost = eye_of_pair("right");
  lost.views[0].camera->pose.reset();
  write_frame(path("lost.exr"), lost);
  expect_refused({left, file("lost.exr")}, 1, {"lost.exr: has no camera with a pose", "--camera FILE"});
}

TEST_F(TwoFiles, EyesThatARendererWrote) {
  const fs::path variants = captures / "variants";
  if (!fs::exists(variants)) GTEST_SKIP() << "no captures at " << captures;
  const Result result = run("hbao+",
                            {variants / "apartment_individual_L.exr", variants / "apartment_individual_R.exr",
                             "--camera", variants / "apartment_stereo.camera.json", "--radius", "0.4"},
                            "out.exr");
  ASSERT_EQ(result.status, 0) << result.err;
  FrameFile out(path("out.exr"), {});
  ASSERT_EQ(out.views(), (std::vector<std::string>{"left", "right"}));
  const Camera left = *out.camera("left"), right = *out.camera("right");
  const dvec3 apart = left.pose->world_to_view * (right.pose->position - left.pose->position);
  EXPECT_NEAR(glm::length(apart - dvec3(0.065, 0, 0)), 0, 1e-5);
  EXPECT_NEAR(right.cx - left.cx, left.fx * 0.065 / 1.95, 1e-2) << "off-axis, converging at 1.95";
}

}  // namespace
}  // namespace gloam::test::two_files_test
