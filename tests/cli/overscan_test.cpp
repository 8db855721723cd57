// Frames with a margin around the picture: gloam capture --overscan, and what commands make of it.
#include <bit>

#include "cli/gloam_process.h"
#include "gloam/margin.h"
#include "support/techniques.h"

namespace gloam::test::overscan_test {
namespace {

Frame stored(const std::string& path) {
  ReadOptions options;
  options.as_stored = true;
  FrameFile file(path, options);
  return file.read(file.common_planes());
}

/// Number of values that differ in their bits, over the pixels of `window`.
int differing(const Frame& a, const Frame& b, const std::string& plane, const Window& window) {
  int count = 0;
  for (size_t v = 0; v < a.views.size(); ++v) {
    const Plane own = part_of(a.views[v].planes.at(plane), a.window, window),
                other = part_of(b.views[v].planes.at(plane), b.window, window);
    for (size_t c = 0; c < own.channels.size(); ++c)
      for (int y = 0; y < window.height(); ++y)
        for (int x = 0; x < window.width(); ++x)
          count +=
              std::bit_cast<uint32_t>(own.channels[c].at(x, y)) != std::bit_cast<uint32_t>(other.channels[c].at(x, y));
  }
  return count;
}

/// As `differing`, of all planes; every plane of `a` is in `b`.
int differing(const Frame& a, const Frame& b, const Window& window) {
  int count = 0;
  for (const std::string& plane : common_planes(a)) count += differing(a, b, plane, window);
  return count;
}

class Overscan : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  /// Runs, and expects no error.
  Result done(const Arguments& arguments) const {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }

  /// A frame of 64x36 with 20 pixels more on each side.
  std::string with_margin(const std::string& scene = "temple") {
    done({"capture", scene, "-o", file("frame.exr"), "--size", "64x36", "--overscan", "20px"});
    return file("frame.exr");
  }

  void expect_same_picture(Arguments capture, const std::string& name) {
    capture.insert(capture.begin(), "capture");
    capture.insert(capture.end(), {"--size", "48x27", "-o"});
    Arguments with = capture;
    capture.push_back(file("plain_" + name));
    with.insert(with.end(), {file("wide_" + name), "--overscan", "15px"});
    done(capture);
    done(with);
  }
};

constexpr Window picture = {0, 0, 64, 36}, whole = {-20, -20, 84, 56};

TEST_F(Overscan, PictureHasTheBitsOfACaptureWithoutIt) {
  std::ofstream(path("ortho.camera.json"))
      << R"({"width": 48, "height": 27, "orthographic": true, "pixels_per_unit": 9.7,
    "cx": 24.3, "cy": 13.1, "camera_to_world": [[1,0,0,0],[0,1,0,1.5],[0,0,1,6],[0,0,0,1]]})";
  const std::vector<std::pair<std::string, Arguments>> captures = {
      {"pair.exr",
       {"colonnade", "--stereo", "0.065", "--convergence", "2.3", "--peel", "3", "--peel-light", "--stochastic", "4",
        "--stochastic-surfaces", "all", "--stochastic-subset", "stratified", "--outlines", "0.2", "--planes",
        "normal,albedo,color,roughness,reflectance,position,back_depth,instance,ambient,metallic,emission"}},
      {"turned.exr", {"courtyard", "--view2", "25"}},
      {"flat.exr", {"gallery", "--camera", file("ortho.camera.json"), "--peel", "2"}},
      {"moved.####.exr", {"clockwork", "--shot", "gears", "--frames", "3"}}};
  for (const auto& [name, flags] : captures) {
    expect_same_picture(flags, name);
    std::string of_frame = name;
    if (const size_t at = name.find("####"); at != std::string::npos) of_frame.replace(at, 4, "0003");
    const Frame plain = stored(file("plain_" + of_frame)), wide = stored(file("wide_" + of_frame));
    EXPECT_EQ(wide.display, plain.display) << name;
    EXPECT_EQ(wide.window, (Window{-15, -15, 63, 42})) << name;
    EXPECT_EQ(common_planes(wide), common_planes(plain)) << name;
    EXPECT_EQ(differing(plain, wide, plain.window), 0) << name;
    EXPECT_EQ(FrameFile(file("plain_" + of_frame), {}).number_attribute("aoRadius"),
              FrameFile(file("wide_" + of_frame), {}).number_attribute("aoRadius"))
        << name << ": the radius is that of the picture";
    const Plane depth = wide.views[0].planes.at("depth").clone();
    int surfaces = 0;
    for (int x = 0; x < 15; ++x) surfaces += !is_background(depth.channels[0].at(x, 28));
    EXPECT_GT(surfaces, 0) << name << ": the margin is rendered";
  }
}

TEST_F(Overscan, AShareGoesByWidthAndHeight) {
  const Result result = done({"capture", "plane", "-o", file("p.exr"), "--size", "64x36", "--overscan", "12.5%",
                              "--picture", file("p.png"), "--json", "-"});
  EXPECT_EQ(result.json()["margin"], nlohmann::json({8, 5}));
  EXPECT_EQ(FrameFile(file("p.exr"), {}).window(), (Window{-8, -5, 72, 41}));
  EXPECT_EQ(png_size(file("p.png")), std::pair(64, 36)) << "a picture shows the display window";
}

TEST_F(Overscan, UnitsAndDisplaysAreTold) {
  const auto refused = [&](const Arguments& more, const std::string& says) {
    Arguments arguments = {"capture", "plane", "-o", file("p.exr"), "--size", "64x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = gloam(arguments);
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
  };
  refused({"--overscan", "10"}, "--overscan 10 has no unit; write 10% of the size on each side, or 64px");
  refused({"--overscan", "-1px"}, "--overscan -1px: margin");
  refused({"--overscan", "501%"}, "0 to 500");
  refused({"--overscan", "60000px"}, "is too large");
  refused({"--overscan", "5px", "--display", GLOAM_SOURCE_DIR "/data/displays/small.json"}, "light-field display");
}

TEST_F(Overscan, RunUsesTheMarginAndWritesThePicture) {
  const std::string frame = with_margin();
  const Result result =
      done({"run", "gtao", frame, "-o", file("ao.exr"), "--picture", file("ao.png"), "--radius", "1"});
  EXPECT_NE(result.err.find("margin: 20 pixels on each side beside the display window are not written; --keep-margin "
                            "writes them"),
            std::string::npos)
      << result.err;
  const Result kept = done(
      {"run", "gtao", frame, "-o", file("kept.exr"), "--keep-margin", "--picture", file("kept.png"), "--radius", "1"});
  EXPECT_EQ(kept.err.find("margin"), std::string::npos) << kept.err;
  const Frame ao = stored(file("ao.exr")), all = stored(file("kept.exr"));
  EXPECT_EQ(ao.window, picture);
  EXPECT_EQ(ao.display, picture);
  EXPECT_EQ(all.window, whole);
  EXPECT_EQ(differing(ao, all, "ao", picture), 0);
  EXPECT_EQ(png_size(file("ao.png")), std::pair(64, 36));
  EXPECT_EQ(png_size(file("kept.png")), std::pair(104, 76));
  done({"capture", "temple", "-o", file("plain.exr"), "--size", "64x36"});
  done({"run", "gtao", file("plain.exr"), "-o", file("without.exr"), "--radius", "1"});
  EXPECT_GT(differing(ao, stored(file("without.exr")), "ao", {0, 0, 64, 3}), 20)
      << "what lies above the picture occludes";
}

TEST_F(Overscan, EveryFileOfARunHasThePicture) {
  const std::string frame = with_margin("gallery");
  done({"run", "ao", frame, "-o", file("ao.exr"), "--into", file("copy.exr"), "--composite", file("lit.exr"),
        "--keep-depth"});
  EXPECT_EQ(FrameFile(file("ao.exr"), {}).data_window("depth", ""), picture);
  EXPECT_EQ(FrameFile(file("lit.exr"), {}).window(), picture);
  FrameFile copy(file("copy.exr"), {});
  EXPECT_EQ(copy.data_window("ao", ""), picture);
  EXPECT_EQ(copy.data_window("depth", ""), whole) << "the copy is whole";
  const Frame ao = stored(file("ao.exr"));
  ReadOptions as_stored;
  as_stored.as_stored = true;
  FrameFile copied(file("copy.exr"), as_stored);
  EXPECT_EQ(differing(ao, copied.read({"ao"}), "ao", picture), 0);
  done({"auto", frame, "-o", file("auto.exr"), "--composite", file("picture.exr"), "--mask", "never"});
  EXPECT_EQ(FrameFile(file("auto.exr"), {}).window(), picture);
  EXPECT_EQ(FrameFile(file("picture.exr"), {}).window(), picture);
  done({"auto", frame, "-o", file("auto.exr"), "--mask", "never", "--keep-margin"});
  EXPECT_EQ(FrameFile(file("auto.exr"), {}).window(), whole);
}

TEST_F(Overscan, AShotGoesOnFromItsMarginAndWritesThePicture) {
  done({"capture", "gallery", "-o", file("f.####.exr"), "--shot", "walk", "--frames", "1-3", "--size", "64x36",
        "--overscan", "20px"});
  const Result result = done({"run", "gtao", file("f.####.exr"), "-o", file("ao.####.exr"), "--temporal"});
  EXPECT_NE(result.err.find("--keep-margin writes them"), std::string::npos) << result.err;
  done({"run", "gtao", file("f.####.exr"), "-o", file("kept.####.exr"), "--temporal", "--keep-margin"});
  const Frame ao = stored(file("ao.0003.exr")), kept = stored(file("kept.0003.exr"));
  EXPECT_EQ(ao.window, picture);
  EXPECT_EQ(kept.window, whole);
  EXPECT_EQ(differing(ao, kept, "ao", picture), 0) << "the history holds the margin";
  // One frame after another: the file is the history, and has to hold it.
  std::string before;
  for (const char* number : {"1", "2", "3"}) {
    Arguments run = {"run",       "gtao", file("f.000") + number + ".exr", "-o", file("h.000") + number + ".exr",
                     "--temporal"};
    if (!before.empty()) run.insert(run.end(), {"--history", before});
    const Result one = done(run);
    EXPECT_NE(one.err.find("are written too, as the next frame goes on from them"), std::string::npos) << one.err;
    before = file("h.000") + number + ".exr";
  }
  EXPECT_EQ(FrameFile(before, {}).window(), whole);
  done({"auto", file("f.####.exr"), "-o", file("auto.####.exr"), "--composite", file("lit.####.exr")});
  EXPECT_EQ(FrameFile(file("auto.0002.exr"), {}).window(), picture);
  EXPECT_EQ(FrameFile(file("lit.0002.exr"), {}).window(), picture);
}

TEST_F(Overscan, TruthIsOfThePicture) {
  const std::string frame = with_margin();
  done({"capture", "temple", "-o", file("plain.exr"), "--size", "64x36"});
  done({"reference", "ao", frame, "-o", file("truth.exr"), "--samples", "32"});
  done({"reference", "ao", file("plain.exr"), "-o", file("plain_truth.exr"), "--samples", "32"});
  done({"reference", "ao", frame, "-o", file("wide_truth.exr"), "--samples", "32", "--keep-margin"});
  const Frame truth = stored(file("truth.exr"));
  EXPECT_EQ(truth.window, picture);
  EXPECT_EQ(differing(truth, stored(file("plain_truth.exr")), picture), 0) << "a truth needs no margin";
  EXPECT_EQ(stored(file("wide_truth.exr")).window, whole);
}

TEST_F(Overscan, ResultsAreMeasuredAgainstTruthsOfEitherWindow) {
  const std::string frame = with_margin();
  done({"reference", "ao", frame, "-o", file("truth.exr"), "--samples", "32"});
  done({"reference", "ao", frame, "-o", file("wide.exr"), "--samples", "32", "--keep-margin"});
  done({"run", "gtao", frame, "-o", file("ao.exr")});
  done({"run", "gtao", frame, "-o", file("kept.exr"), "--keep-margin"});
  const auto compared = [&](const std::string& test, const std::string& truth) {
    return done({"compare", file(test), file(truth), "--frame", frame, "--json", "-"}).json();
  };
  const nlohmann::json figures = compared("ao.exr", "truth.exr");
  EXPECT_EQ(compared("kept.exr", "truth.exr")["rmse"], figures["rmse"]);
  EXPECT_EQ(figures["pixels"], compared("kept.exr", "truth.exr")["pixels"]);
  EXPECT_LE(int(figures["pixels"]), 64 * 36);
  const auto picked = [&](const std::string& truth) {
    const nlohmann::json json =
        done({"pick", frame, "--truth", file(truth), "--techniques", "gtao", "--budget", "10s", "--json", "-"}).json();
    return double(json["rmse"]);
  };
  EXPECT_NEAR(picked("truth.exr"), figures["rmse"], 0.05);
  EXPECT_LT(picked("truth.exr"), 1) << "a truth of the picture alone is measured against";
  done({"view", frame, file("ao.exr"), file("truth.exr"), "-o", file("look.html")});
}

TEST_F(Overscan, InfoTellsTheMarginAndAFlagWithoutEffectIsTold) {
  const std::string frame = with_margin();
  EXPECT_NE(
      done({"info", frame}).out.find("64 x 36, data to 104 x 76 at (-20, -20), a margin of 20 pixels on each side"),
      std::string::npos);
  done({"capture", "temple", "-o", file("plain.exr"), "--size", "64x36"});
  const Result result = done({"run", "gtao", file("plain.exr"), "-o", file("ao.exr"), "--keep-margin"});
  EXPECT_NE(result.err.find("--keep-margin: the frame has no margin"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace gloam::test::overscan_test
