// gloam compare --stereo: the document, the pictures, where depth, normals and cameras come from, and bad input.
#include <fmt/format.h>

#include <cmath>

#include "cli/gloam_process.h"
#include "support/long.h"
#include "support/stress.h"
#include "unit/pictures.h"
#include "unit/read_channel.h"

namespace gloam::test::stereo_test {
namespace {

using Json = nlohmann::json;

constexpr int width = 96, height = 64;
constexpr float offset = 0.125f;
const Scene wall = tilted_plane(4, 0, 0);

/// A wall whose AO rises evenly, and is `offset` too high in the second view.
Frame pair_with_offset() {
  const Shot shot = perspective(width, height);
  Frame frame = shoot_pair({eye_at(shot, {-0.1, 0, 0}), eye_at(shot, {0.123, 0, 0})}, wall,
                           [](const glm::dvec3& p) { return 0.5 + 0.1 * p.x; });
  Channel& ao = frame.views[1].planes["ao"].channels[0];
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) ao.at(x, y) += offset;
  }
  return frame;
}

/// Files as left by `gloam run` and by a renderer: the result without normals, the frame without a result.
void write_result_and_frame(const fs::path& result, const fs::path& frame) {
  Frame both = pair_with_offset();
  for (View& view : both.views) view.planes.erase("normal");
  write_frame(result, both);
  both = pair_with_offset();
  for (View& view : both.views) view.planes.erase("ao");
  write_frame(frame, both);
}

/// One view alone: the plane, without a camera.
void write_eye(const fs::path& path, const char* view, const char* plane = "ao", int columns = width) {
  Frame frame = pair_with_offset();
  std::swap(frame.views[0], frame.view(view));
  frame.views.pop_back();
  Frame bare = blank(perspective(columns, height));
  bare.views[0].camera.reset();
  bare.views[0].planes[plane] = Plane{plane, {}};
  bare.views[0].planes[plane].channels.emplace_back(Layout(columns, height), 0.0f);
  if (columns == width) bare.views[0].planes[plane].channels[0] = std::move(frame.views[0].planes["ao"].channels[0]);
  write_frame(path, bare);
}

TEST_F(Cli, StereoDocumentHasTheErrorOfBothViews) {
  write_frame(path("pair.exr"), pair_with_offset());
  const Result result = gloam({"compare", "--stereo", path("pair.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json document = result.json();
  for (const char* key : {"left", "right", "mean"}) EXPECT_NEAR(document["inconsistency"][key], offset, 1e-6) << key;
  for (const char* key : {"rmse", "p99", "max"}) EXPECT_NEAR(document[key], offset, 1e-6) << key;
  EXPECT_EQ(document["plane"], "ao");
  EXPECT_EQ(document["views"], Json({"left", "right"}));
  EXPECT_EQ(document["normal_check"], 6);
  // 4.6 pixels of the 96 are outside the other image, and one more has a neighbour that is.
  const long long rejected = 2 * 5 * height;
  EXPECT_EQ(document["pixels"], 2 * width * height - rejected);
  EXPECT_NEAR(document["rejected_share"], double(rejected) / (2 * width * height), 1e-12);
  EXPECT_EQ(document["rejected"], Json({{"outside", rejected}, {"hidden", 0}, {"edge", 0}}));
}

TEST_F(Cli, StereoFiguresAreATableForPeople) {
  write_frame(path("pair.exr"), pair_with_offset());
  const Result result = gloam({"compare", "--stereo", path("pair.exr")});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* words :
       {"stereo inconsistency, normal-check 6 degrees", "\nleft ", "\nright ", "\nboth ", "0.12500"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << ": " << result.out;
}

TEST_F(Cli, StereoTakesViewsInTheOrderAskedFor) {
  Frame frame = pair_with_offset();
  for (int y = 0; y < height; ++y) frame.views[0].planes["depth"].channels[0].at(60, y) = INFINITY;
  write_frame(path("pair.exr"), frame);
  const Json a = gloam({"compare", "--stereo", path("pair.exr"), "--json", "-"}).json();
  const Json b = gloam({"compare", "--stereo", path("pair.exr"), "--views", "right,left", "--json", "-"}).json();
  EXPECT_NE(a["inconsistency"]["left"], a["inconsistency"]["right"]);
  EXPECT_EQ(a["inconsistency"]["left"], b["inconsistency"]["right"]);
  EXPECT_EQ(a["inconsistency"]["right"], b["inconsistency"]["left"]);
  EXPECT_EQ(b["views"], Json({"right", "left"}));
}

TEST_F(Cli, StereoTakesNormalsFromTheFrameAndSaysWhereThereAreNone) {
  write_result_and_frame(path("ao.exr"), path("frame.exr"));
  const Result without = gloam({"compare", "--stereo", path("ao.exr"), "--json", "-"});
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_TRUE(without.json()["normal_check"].is_null());
  EXPECT_NE(without.err.find("no normals for both views"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--frame"), std::string::npos) << without.err;
  const Result with = gloam(
      {"compare", "--stereo", path("ao.exr"), "--frame", path("frame.exr"), "--normal-check", "3", "--json", "-"});
  ASSERT_EQ(with.status, 0) << with.err;
  EXPECT_EQ(with.err, "");
  EXPECT_EQ(with.json()["normal_check"], 3);
  EXPECT_NEAR(with.json()["inconsistency"]["mean"], offset, 1e-6);
  const Result off =
      gloam({"compare", "--stereo", path("ao.exr"), "--frame", path("frame.exr"), "--no-normal-check", "--json", "-"});
  EXPECT_TRUE(off.json()["normal_check"].is_null());
  EXPECT_EQ(off.err, "") << "as asked";
}

/// The wall's normals in the second view are tilted by 20 degrees.
TEST_F(Cli, StereoNormalCheckIsWhatTheFlagSays) {
  Frame frame = pair_with_offset();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width / 2; ++x) {
      frame.views[1].planes["normal"].channels[1].at(x, y) = float(std::sin(20 * M_PI / 180));
      frame.views[1].planes["normal"].channels[2].at(x, y) = float(std::cos(20 * M_PI / 180));
    }
  }
  write_frame(path("pair.exr"), frame);
  const auto edges = [&](const Arguments& more) {
    Arguments all = {"compare", "--stereo", path("pair.exr"), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all).json()["rejected"]["edge"].get<int>();
  };
  EXPECT_GT(edges({}), width / 2 * height);
  EXPECT_EQ(edges({"--normal-check", "19"}), edges({}));
  EXPECT_EQ(edges({"--normal-check", "21"}), 0);
  EXPECT_EQ(edges({"--no-normal-check"}), 0);
}

TEST_F(Cli, StereoComparesTwoFilesOfOneEyeEach) {
  write_result_and_frame(path("ao.exr"), path("frame.exr"));
  write_eye(path("a.exr"), "left");
  write_eye(path("b.exr"), "right");
  const Result whole = gloam({"compare", "--stereo", path("ao.exr"), "--frame", path("frame.exr"), "--json", "-"});
  const Result result =
      gloam({"compare", "--stereo", path("a.exr"), path("b.exr"), "--frame", path("frame.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.findings(), whole.findings());
  const Result other = gloam({"compare", "--stereo", path("a.exr"), path("b.exr"), "--frame", path("frame.exr"),
                              "--views", "right,left", "--json", "-"});
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_GT(std::abs(other.json()["inconsistency"]["mean"].get<double>() - offset), 0.01) << "the wrong way round";
}

/// The frame covers more than the display window, the result only that window.
TEST_F(Cli, StereoFrameMayCoverMoreThanTheResult) {
  Frame frame = pair_with_offset(), part = pair_with_offset();
  frame.display = part.display = part.window = {16, 8, 80, 56};
  for (View& view : part.views) {
    view.planes.erase("depth");
    view.planes.erase("normal");
    view.camera.reset();
    Channel cut(Layout(64, 48), 0.0f), &ao = view.planes["ao"].channels[0];
    for (int y = 0; y < 48; ++y) std::copy_n(ao.row(y + 8) + 16, 64, cut.row(y));
    ao = std::move(cut);
  }
  write_frame(path("frame.exr"), frame);
  write_frame(path("part.exr"), part);
  const Result result = gloam({"compare", "--stereo", path("part.exr"), "--frame", path("frame.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(result.json()["inconsistency"]["mean"], offset, 1e-6);
  EXPECT_NEAR(result.json()["max"], offset, 1e-6);
  EXPECT_EQ(result.json()["pixels"], 2 * (64 - 5) * 48);
}

/// Some renderers lose the position of a crop: the pixels are the same, but begin at another corner.
TEST_F(Cli, StereoFrameMayStartAtAnotherCorner) {
  Frame frame = pair_with_offset(), moved = pair_with_offset();
  move_window(moved, 100, -50);
  for (View& view : moved.views) {
    view.planes.erase("depth");
    view.planes.erase("normal");
    view.camera.reset();
  }
  write_frame(path("frame.exr"), frame);
  write_frame(path("moved.exr"), moved);
  const Result whole = gloam({"compare", "--stereo", path("frame.exr"), "--json", "-"});
  const Result result = gloam({"compare", "--stereo", path("moved.exr"), "--frame", path("frame.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.findings(), whole.findings());
}

TEST_F(Cli, StereoPicturesHaveTheSizeOfTheImageAndALegend) {
  write_frame(path("pair.exr"), pair_with_offset());
  const Result result =
      gloam({"compare", "--stereo", path("pair.exr"), "-o", path("errors.png"), "--magnify", "4", "--anaglyph",
             path("anaglyph.png"), "--side-by-side", path("beside.png"), "--json", path("figures.json")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(files(),
            (std::vector<std::string>{"anaglyph.png", "beside.png", "errors.png", "figures.json", "pair.exr"}));
  for (const char* name : {"errors.png", "anaglyph.png", "beside.png"})
    EXPECT_NE(result.out.find(path(name).string()), std::string::npos) << "said to be written";
  const Picture errors = picture_in(path("errors.png")), anaglyph = picture_in(path("anaglyph.png")),
                beside = picture_in(path("beside.png"));
  EXPECT_GT(errors.width, 320) << "the legend's";
  EXPECT_GT(errors.height, height) << "the legend lies under the image";
  EXPECT_EQ(anaglyph.width, width);
  EXPECT_EQ(anaglyph.height, height);
  EXPECT_EQ(beside.width, 2 * width);
  EXPECT_EQ(beside.height, height);
  EXPECT_EQ(errors.at(50, 30), (Pixel{128, 128, 128})) << "4 x 0.125";
  const Pixel rejected = errors.at(0, 30);  // the wall's left end is outside the right eye's image
  EXPECT_GT(rejected.r, rejected.g + 20);
  EXPECT_EQ(anaglyph.at(50, 30).r, beside.at(50, 30).r);
  EXPECT_EQ(anaglyph.at(50, 30).g, beside.at(width + 50, 30).g);
  EXPECT_NEAR(anaglyph.at(50, 30).g - anaglyph.at(50, 30).r, 255 * (offset + 0.1 * 0.223), 2);
}

TEST_F(Cli, StereoErrorsAreWrittenAsTheyAre) {
  write_frame(path("pair.exr"), pair_with_offset());
  ASSERT_EQ(gloam({"compare", "--stereo", path("pair.exr"), "-o", path("errors.exr")}).status, 0);
  const Channel left = read_channel(path("errors.exr"), "inconsistency");
  const Channel right = read_channel(path("errors.exr"), "right.inconsistency");
  EXPECT_NEAR(left.at(50, 30), offset, 1e-6);
  EXPECT_NEAR(right.at(50, 30), offset, 1e-6);
  EXPECT_TRUE(std::isnan(left.at(0, 30)));
  EXPECT_FALSE(std::isnan(right.at(0, 30)));
  EXPECT_TRUE(std::isnan(right.at(width - 1, 30)));
  EXPECT_EQ(read_channel(path("errors.exr"), "Z").at(50, 30), 4);
}

TEST_F(Cli, StereoComparesTheResultFirst) {
  const auto plane = [&](const std::vector<std::string>& planes, const Arguments& more = {}) {
    Frame frame = pair_with_offset();
    for (View& view : frame.views) {
      const Plane ao = view.planes["ao"].clone();
      view.planes.erase("ao");
      for (const std::string& name : planes) {
        view.planes[name] = {name, {}};
        for (int i = 0; i < (name == "color" ? 3 : 1); ++i)
          view.planes[name].channels.push_back(ao.channels[0].clone());
      }
    }
    write_frame(path("pair.exr"), frame);
    Arguments all = {"compare", "--stereo", path("pair.exr"), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Json document = gloam(all).json();
    return document["plane"].get<std::string>() + fmt::format(" {:.4f}", document["max"].get<double>());
  };
  EXPECT_EQ(plane({"color", "ao_raw", "ao"}), "ao 0.1250");
  EXPECT_EQ(plane({"color", "ao_raw"}), "ao_raw 0.1250");
  EXPECT_EQ(plane({"color", "ao_raw", "ao"}, {"--what", "color"}), "color 0.2165") << "the length: sqrt(3) / 8";
  EXPECT_EQ(plane({"color", "roughness"}), "color 0.2165");
  EXPECT_EQ(plane({}), "normal 0.0000") << "not the depth, which is the first";
}

// ---------------------------------------------------------------------------------------------------------------------
// Bad input

void expect_refused(const Result& result, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_TRUE(result.out.empty()) << result.out;
  for (const std::string& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' is not in: " << result.err;
}

TEST_F(Cli, StereoWrongUsage) {
  const std::string pair = path("pair.exr"), png = path("x.png");
  write_frame(pair, pair_with_offset());
  expect_refused(gloam({"compare", pair}), 2, {"REF.exr is required", "--stereo"});
  for (const Arguments& flag :
       {Arguments{"--anaglyph", png}, Arguments{"--side-by-side", png}, Arguments{"--no-normal-check"},
        Arguments{"--normal-check", "6"}, Arguments{"--magnify", "2"}}) {
    Arguments all = {"compare", pair, pair};
    all.insert(all.end(), flag.begin(), flag.end());
    expect_refused(gloam(all), 2, {flag[0], "requires --stereo"});
  }
  const auto stereo = [&](const Arguments& more) {
    Arguments all = {"compare", "--stereo", pair};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  };
  expect_refused(stereo({"--normal-check", "0"}), 2, {"--normal-check", "0.1 to 180"});
  expect_refused(stereo({"--normal-check", "x"}), 2, {"--normal-check x", "0.1 to 180"});
  expect_refused(stereo({"--normal-check", "6", "--no-normal-check"}), 2, {"--no-normal-check"});
  expect_refused(stereo({"--magnify", "0"}), 2, {"--magnify"});
  expect_refused(stereo({"-o", path("x.jpg")}), 2, {"-o", ".png"});
  expect_refused(stereo({"--anaglyph", path("x.exr")}), 2, {"--anaglyph", ".png"});
  expect_refused(stereo({"--side-by-side", path("x.exr")}), 2, {"--side-by-side", ".png"});
  expect_refused(stereo({"--anaglyph", png, "--side-by-side", png}), 2, {"--side-by-side", "also --anaglyph"});
  expect_refused(stereo({"-o", pair}), 2, {"also the result"});
  expect_refused(stereo({"--view", "left"}), 2, {"--view left", "--views A,B"});
  expect_refused(stereo({"--what", "depth"}), 2, {"--what depth"});
  EXPECT_EQ(files(), std::vector<std::string>{"pair.exr"});
}

TEST_F(Cli, StereoNamesWhatIsMissing) {
  const std::string pair = path("pair.exr"), out = path("x.png");
  const auto refused = [&](const std::function<void(Frame&)>& spoil, const std::vector<std::string>& words,
                           const Arguments& more = {}) {
    Frame frame = pair_with_offset();
    spoil(frame);
    write_frame(pair, frame);
    Arguments all = {"compare", "--stereo", pair, "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(gloam(all), 1, words);
    EXPECT_FALSE(fs::exists(out));
  };
  refused([](Frame& f) { f.views.pop_back(); }, {"pair.exr", "one view", "file of the other eye"});
  refused([](Frame& f) { f.views.push_back(std::move(pair_with_offset().views[0])), f.views[2].name = "third"; },
          {"pair.exr", "left, right and third", "--views A,B"});
  refused([](Frame& f) { f.views[1].camera->pose.reset(); }, {"pair.exr", "camera with a pose", "--camera FILE"});
  refused([](Frame& f) { f.views[0].planes.erase("depth"); }, {"pair.exr", "no depth", "--frame"});
  refused([](Frame&) {}, {"pair.exr", "no plane 'oa'", "did you mean 'ao'"}, {"--what", "oa"});
  refused([](Frame& f) { f.views[1].camera->pose->position.x += 50; }, {"no surface in common"});
  refused([](Frame& f) { f.views[1].planes["ao"].channels[0].at(40, 20) = NAN; }, {"'ao' is not finite", "'left'"});
  const auto only_depth = [](Frame& f) {
    for (View& view : f.views) view.planes.erase("ao"), view.planes.erase("normal");
  };
  refused(only_depth, {"pair.exr", "nothing that can be compared"});
}

TEST_F(Cli, StereoFilesThatDoNotFitAreNamed) {
  write_result_and_frame(path("ao.exr"), path("frame.exr"));
  write_eye(path("a.exr"), "left");
  write_eye(path("b.exr"), "right");
  write_eye(path("small.exr"), "right", "ao", 40);
  write_eye(path("raw.exr"), "right", "ao_raw");
  const auto refused = [&](const Arguments& files, const std::vector<std::string>& words) {
    Arguments all = {"compare", "--stereo"};
    for (const std::string& file : files) all.push_back(file[0] == '-' ? file : path(file).string());
    expect_refused(gloam(all), 1, words);
  };
  refused({"a.exr", "b.exr"}, {"a.exr", "camera with a pose", "--frame"});
  refused({"a.exr", "small.exr", "--frame", "frame.exr"}, {"a.exr", "96x64", "small.exr", "40x64"});
  refused({"small.exr", "small.exr", "--frame", "frame.exr"}, {"frame.exr", "96x64", "40x64"});
  refused({"a.exr", "raw.exr", "--frame", "frame.exr"}, {"nothing that can be compared"});
  refused({"a.exr", "ao.exr", "--frame", "frame.exr"}, {"ao.exr", "left and right", "of two files each holds one"});
  refused({"ao.exr", "--frame", "a.exr"}, {"a.exr", "one view"});
  refused({"ao.exr", "--frame", "none.exr"}, {"none.exr"});
  refused({"none.exr"}, {"none.exr"});
}

/// World-space normals without a pose to rotate them.
TEST_F(Cli, StereoNormalsOfNoUseAreNotCompared) {
  Frame frame = pair_with_offset();
  write_frame(path("frame.exr"), frame);
  for (View& view : frame.views) view.camera.reset();
  write_frame(path("normals.exr"), frame);
  expect_refused(gloam({"compare", "--stereo", path("normals.exr"), "--frame", path("frame.exr"), "--what", "normal",
                        "--normal-space", "world"}),
                 1, {"normals.exr", "'normal' is of no use", "the camera's pose is unknown"});
}

/// A frame without cameras has unknown conventions for depth and normals: the result's depth counts.
TEST_F(Cli, StereoTakesCamerasFromTheResultWhereTheFrameHasNone) {
  Frame frame = pair_with_offset();
  write_frame(path("ao.exr"), frame);
  for (View& view : frame.views) {
    view.camera.reset();
    view.planes["depth"].channels[0] = Channel(Layout(width, height), 1.0f);
  }
  write_frame(path("frame.exr"), frame);
  const Result whole = gloam({"compare", "--stereo", path("ao.exr"), "--json", "-"});
  const Result result = gloam({"compare", "--stereo", path("ao.exr"), "--frame", path("frame.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.findings(), whole.findings());
}

// ---------------------------------------------------------------------------------------------------------------------
// A real frame

/// AO by 256 rays per pixel for each eye: the differences are noise and effects between pixels.
TEST_F(Cli, StereoOfTheApartmentsReference) {
  if (!fs::exists(captures)) GTEST_SKIP() << "no captures at " << captures;
  const fs::path folder = captures / "apartment_stereo";
  const auto inconsistency = [&](const Arguments& more) {
    Arguments all = {"compare",
                     "--stereo",
                     folder / "apartment_stereo_ao_ref_left.exr",
                     folder / "apartment_stereo_ao_ref_right.exr",
                     "--frame",
                     folder / "apartment_stereo_exact.exr",
                     "--json",
                     "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  };
  const Json with = inconsistency({}), without = inconsistency({"--no-normal-check"});
  const Json swapped = inconsistency({"--views", "right,left"});
  std::printf("apartment: inconsistency of the reference %.5f, without the normal-check %.5f, eyes swapped %.5f\n",
              with["inconsistency"]["mean"].get<double>(), without["inconsistency"]["mean"].get<double>(),
              swapped["inconsistency"]["mean"].get<double>());
  EXPECT_NEAR(with["inconsistency"]["mean"], 0.0045, 0.0002);
  EXPECT_NEAR(with["rejected_share"], 0.062, 0.005);
  EXPECT_GT(without["inconsistency"]["mean"], 1.2 * with["inconsistency"]["mean"].get<double>());
  EXPECT_LT(without["rejected_share"], with["rejected_share"]);
  EXPECT_GT(swapped["inconsistency"]["mean"], 2 * with["inconsistency"]["mean"].get<double>()) << "the wrong images";
}

/// The ablation of figure 10: each part brings the eyes closer to each other.
TEST_F(Cli, EachPartOfStereoAoBringsTheEyesTogether) {
  ONLY_IN_LONG_RUN();
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("pair.exr"), "--size", "240x135", "--stereo", "0.065"}).status, 0);
  const auto inconsistency = [&](const char* technique, const char* estimate, const char* reproject,
                                 const char* filter) {
    const Result run =
        gloam({"run", technique, path("pair.exr"), "-o", path("ao.exr"), "--set", fmt::format("estimate={}", estimate),
               "--set", fmt::format("reproject={}", reproject), "--set", fmt::format("filter={}", filter)});
    EXPECT_EQ(run.status, 0) << run.err;
    const Result compared = gloam({"compare", "--stereo", path("ao.exr"), "--json", "-"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    EXPECT_EQ(compared.json()["normal_check"], 6);  // the result includes the normals
    return compared.json()["inconsistency"]["mean"].get<double>();
  };
  for (const char* technique : {"stereo-ao", "stereo-gtao", "stereo-bitmask"}) {
    SCOPED_TRACE(technique);
    const double a = inconsistency(technique, "mono", "off", "mono"),
                 b = inconsistency(technique, "stereo", "off", "mono"),
                 c = inconsistency(technique, "stereo", "on", "mono"),
                 d = inconsistency(technique, "stereo", "on", "stereo");
    EXPECT_GT(a, b);
    EXPECT_GT(b, c);
    EXPECT_GT(c, d);
    EXPECT_LT(d, 0.4 * a);
    EXPECT_LT(inconsistency(technique, "stereo", "no-back-check", "stereo2d"), 0.4 * a);
  }
}

TEST_F(Cli, StereoAoSaysWhereTheEyesHaveNothingInCommon) {
  const Shot shot = perspective(width, height);
  for (const double apart : {0.1, 100.0}) {
    write_frame(path("pair.exr"), shoot_pair({eye_at(shot, {0, 0, 0}), eye_at(shot, {apart, 0, 0})}, wall,
                                             [](const glm::dvec3&) { return 1; }));
    const Result result = gloam({"run", "stereo-ao", path("pair.exr"), "-o", path("out.exr")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("the views 'left' and 'right' have no surface in common") != std::string::npos, apart > 1)
        << result.err;
  }
}

TEST_F(Cli, StereoAoNeedsTwoViewsAndPoses) {
  ASSERT_EQ(gloam({"capture", "plane", "-o", path("one.exr"), "--size", "32x18"}).status, 0);
  const Result one = gloam({"run", "stereo-ao", path("one.exr"), "-o", path("ao.exr")});
  EXPECT_EQ(one.status, 1);
  EXPECT_EQ(one.lines_of_error(), 1) << one.err;
  EXPECT_NE(one.err.find("--stereo IPD"), std::string::npos) << one.err;
  ASSERT_EQ(gloam({"capture", "plane", "-o", path("two.exr"), "--size", "32x18", "--stereo", "0.1"}).status, 0);
  const Result wrong = gloam({"run", "stereo-ao", path("two.exr"), "-o", path("ao.exr"), "--set", "primary=middle"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.lines_of_error(), 1) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(path("ao.exr")));
  // A filter for two eyes follows any estimate.
  EXPECT_EQ(gloam({"run", "hbao+", path("two.exr"), "-o", path("ao.exr"), "--filter", "stereo-bilateral"}).status, 0);
}

/// A plane that only one eye has is in no comparison of both: another plane may not take its place unsaid.
TEST_F(Cli, AChoiceOfChannelsThatFitsOneEyeIsRefused) {
  Frame pair = small_frame(32, 24, {"depth", "ao", "ao_raw"});
  pair.views[0].name = "left";
  View right = View{"right", pair.views[0].camera, {}, {}, {}};
  for (const auto& [name, plane] : pair.views[0].planes) right.planes[name] = plane.clone();
  pair.views.push_back(std::move(right));
  write_frame(path("pair.exr"), pair);
  const std::string pair_file = path("pair.exr");
  for (const Arguments& command : {Arguments{"compare", pair_file, pair_file, "--plane", "ao=right.AO_raw"},
                                   {"compare", "--stereo", pair_file, "--plane", "ao=right.AO_raw"},
                                   {"run", "normals", pair_file, "-o", path("n.exr"), "--plane", "depth=right.Z"},
                                   {"auto", pair_file, "-o", path("n.exr"), "--plane", "depth=right.Z"}}) {
    const Result result = gloam(command);
    EXPECT_EQ(result.status, 1) << command[0] << result.out;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    for (const char* words : {"is of view 'right' alone", "view 'left' has no", "--view right"})
      EXPECT_NE(result.err.find(words), std::string::npos) << command[0] << ": " << result.err;
  }
  const Result looked = gloam({"info", pair_file, "--plane", "ao=right.AO_raw"});
  EXPECT_EQ(looked.status, 0) << looked.err;
  EXPECT_NE((looked.out + looked.err).find("is of view 'right' alone"), std::string::npos) << looked.out;
  EXPECT_EQ(gloam({"compare", pair_file, pair_file, "--plane", "ao=right.AO_raw", "--view", "right"}).status, 0);
}

}  // namespace
}  // namespace gloam::test::stereo_test
