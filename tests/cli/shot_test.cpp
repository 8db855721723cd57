// gloam run and gloam info on a shot: what is written, and what happens to frames that are unlike the others.
#include "cli/shot_fixture.h"

namespace gloam::test::shot_test {
namespace {

using Shot = ShotTest;

struct Way {
  std::string technique;
  Arguments of_both, of_shot, of_frame;  ///< flags
  std::vector<std::string> planes;
};

TEST_F(Shot, EachFrameHasTheBitsOfARunOnItAlone) {
  make_shot({1, 2, 5});
  const std::vector<Way> ways = {
      {"hbao+", {}, {}, {"--outputs", "ao", "--half"}, {"ao"}},
      {"hbao+", {}, {"--float", "--keep-depth", "--outputs", "ao,ao_raw"}, {}, {"ao", "ao_raw", "depth"}},
      {"gtao",
       {"--preset", "low", "--filter", "none", "--seed", "7"},
       {"--float"},
       {"--outputs", "ao_raw"},
       {"ao_raw"}},
      {"hbao+", {"--resolution", "half", "--math", "precise"}, {"--float"}, {"--outputs", "ao"}, {"ao"}},
      {"normals", {}, {}, {}, {"normal"}},
  };
  for (const Way& way : ways) {
    Arguments arguments = {"run", way.technique, file("shot.####.exr"), "-o", file("ao.####.exr"), "--frames", "1-2,5"};
    arguments.insert(arguments.end(), way.of_both.begin(), way.of_both.end());
    arguments.insert(arguments.end(), way.of_shot.begin(), way.of_shot.end());
    const Result shot = gloam(arguments);
    ASSERT_EQ(shot.status, 0) << shot.err;
    for (const int number : {1, 2, 5}) {
      arguments = {"run", way.technique, file(numbered("shot", number)), "-o", file("one.exr")};
      arguments.insert(arguments.end(), way.of_both.begin(), way.of_both.end());
      arguments.insert(arguments.end(), way.of_shot.begin(), way.of_shot.end());
      arguments.insert(arguments.end(), way.of_frame.begin(), way.of_frame.end());
      const Result one = gloam(arguments);
      ASSERT_EQ(one.status, 0) << one.err;
      const ReadOptions stored{.as_stored = true};
      FrameFile of_shot(path(numbered("ao", number)), stored), alone(path("one.exr"), stored);
      EXPECT_TRUE(same_bits(of_shot.read(way.planes), alone.read(way.planes))) << way.technique << " " << number;
      EXPECT_EQ(of_shot.text_attribute("gloamParameters"), alone.text_attribute("gloamParameters"));
      EXPECT_EQ(of_shot.text_attribute("gloamRun"), alone.text_attribute("gloamRun"));
      EXPECT_TRUE(of_shot.camera(""));
    }
  }
}

TEST_F(Shot, WritesTheFirstOutputAsHalf) {
  make_shot({1, 2});
  ASSERT_EQ(run().status, 0);
  const FrameFile file(path("ao.0001.exr"), {});
  EXPECT_EQ(file.all_channels(), (std::vector<std::string>{"AO", "Y"}));
  EXPECT_EQ(file.planes()[0].channels[0].type, "half");
  ASSERT_EQ(run({"--float"}).status, 0);
  EXPECT_EQ(FrameFile(path("ao.0001.exr"), {}).planes()[0].channels[0].type, "float");
  ASSERT_EQ(run({"--bare"}).status, 0);
  EXPECT_FALSE(FrameFile(path("ao.0001.exr"), {}).camera(""));
}

TEST_F(Shot, WhatIsTold) {
  make_shot({1, 2, 3});
  const Result people = run();
  EXPECT_NE(people.out.find("wrote 3 frames"), std::string::npos) << people.out;
  EXPECT_NE(people.out.find("frames a second"), std::string::npos) << people.out;
  EXPECT_EQ(people.err, "");
  const Result json = run({"--json", "-"});
  const std::vector<nlohmann::json> lines = lines_of(json.out);
  ASSERT_EQ(lines.size(), 4u) << json.out;
  std::set<int> frames;
  for (size_t i = 0; i < 3; ++i) {
    frames.insert(lines[i]["frame"].get<int>());
    EXPECT_EQ(lines[i]["status"], "done");
    EXPECT_TRUE(lines[i]["error"].is_null());
    EXPECT_GT(lines[i]["ms"], 0);
  }
  EXPECT_EQ(frames, (std::set<int>{1, 2, 3}));
  EXPECT_EQ(lines[3]["frames"], 3);
  EXPECT_EQ(lines[3]["done"], 3);
  EXPECT_EQ(lines[3]["skipped"], 0);
  EXPECT_EQ(lines[3]["failed"], 0);
  for (const char* figure : {"fps", "decode_ms", "compute_ms", "write_ms"}) EXPECT_GT(lines[3][figure], 0) << figure;
  ASSERT_EQ(run({"--json", file("figures.json")}).status, 0);
  EXPECT_EQ(lines_of(slurp(path("figures.json"))).size(), 4u);
}

TEST_F(Shot, AFrameThatFailsLeavesTheOthers) {
  make_shot({1, 2, 3, 4, 5, 6});
  std::ofstream(path(numbered("shot", 2))) << "no EXR";
  write_frame(path(numbered("shot", 4)), frame_of(4, 80, 48));
  write_frame(path(numbered("shot", 5)), small_frame(64, 48, {"color"}));
  const Result result = run({"--json", file("figures.json")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 4) << result.err;
  for (const char* line :
       {"gloam: frame 2: ", "gloam: frame 4: shot.0004.exr: is 80x48, and the shot's first frame 64x48",
        "gloam: frame 5: ", "gloam: 3 of 6 frames failed: 2, 4-5\n"})
    EXPECT_NE(result.err.find(line), std::string::npos) << line << result.err;
  EXPECT_NE(result.err.find("needs 'depth'"), std::string::npos) << result.err;
  EXPECT_EQ(contents().size(), 3u);
  const std::vector<nlohmann::json> lines = lines_of(slurp(path("figures.json")));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[6]["done"], 3);
  EXPECT_EQ(lines[6]["failed"], 3);
  for (const nlohmann::json& line : lines) {
    if (line.contains("status")) {
      EXPECT_EQ(line["status"] == "failed", line["error"].is_string()) << line;
    }
  }
}

TEST_F(Shot, AFirstFrameThatFailsLeavesTheOthers) {
  make_shot({1, 2, 3});
  std::ofstream(path(numbered("shot", 1))) << "no EXR";
  const Result result = run();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(contents().size(), 2u) << result.err;
  for (const int number : {2, 3}) std::ofstream(path(numbered("shot", number))) << "no EXR";
  expect_refused(run_of({}), 1, {"none of the 3 frames", "shot.0001.exr"});
}

TEST_F(Shot, MissingFrames) {
  make_shot({1, 2, 5});
  expect_refused(run_of({"--frames", "1-5"}), 1, {"frames 3-4 are missing", "shot.0003.exr", "--missing"});
  expect_refused(run_of({"--frames", "8-9"}), 1, {"frames 8-9 are missing"});
  const Result skipped = run({"--frames", "1-5", "--missing", "skip"});
  EXPECT_EQ(skipped.status, 0) << skipped.err;
  EXPECT_NE(skipped.err.find("3-4 missing: left out"), std::string::npos) << skipped.err;
  EXPECT_EQ(contents().size(), 3u);
  ASSERT_EQ(run({"--frames", "1-5", "--missing", "hold"}).status, 0);
  EXPECT_EQ(contents().size(), 5u);
  EXPECT_EQ(slurp(path("ao.0004.exr")), slurp(path("ao.0002.exr"))) << "the frame before";
  EXPECT_NE(slurp(path("ao.0004.exr")), slurp(path("ao.0005.exr")));
}

TEST_F(Shot, RefusesInOneLine) {
  make_shot({1, 2});
  const std::string shot = file("shot.####.exr"), one = file("shot.0001.exr"), out = file("ao.####.exr");
  const auto run_on = [&](const Arguments& more) {
    Arguments all = {"run", "hbao+"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused(run_on({file("none.####.exr"), "-o", out}), 1, {"no file of this pattern"});
  expect_refused(run_on({shot, "-o", file("ao.exr")}), 2, {"is one file", "patterns"});
  expect_refused(run_on({one, "-o", out}), 2, {"is a pattern", "is one frame"});
  expect_refused(run_on({shot, one, "-o", out}), 2, {"shot.0001.exr: is one frame"});
  expect_refused(run_on({shot, "-o", shot}), 2, {"is also what frame 1 is read from"});
  expect_refused(run_on({shot, "-o", file("shot.%04d.exr")}), 2, {"is also what frame 1 is read from"});
  expect_refused(run_on({shot, "-o", file("./sho##.####.exr")}), 2, {"several places"});
  expect_refused(run_on({shot, "-o", file("none/ao.####.exr")}), 1, {"is not a folder"});
  expect_refused(run_on({shot, "-o", file("ao.####.png")}), 2, {".exr"});
  expect_refused(run_on({shot, "-o", out, "--picture", file("a.png")}), 2, {"--picture"});
  expect_refused(run_on({shot, "-o", out, "--repeat", "3"}), 2, {"--repeat 3"});
  expect_refused(run_on({shot, "-o", out, "--history", one}), 2, {"--history"});
  expect_refused(run_on({shot, "-o", out, "--half", "--float"}), 2, {"--float"});
  expect_refused(run_on({shot, "-o", out, "--radius", "x"}), 2, {"radius"});
  expect_refused(run_on({shot, "-o", out, "--frames", "2-1"}), 2, {"--frames 2-1"});
  for (const Arguments& flag :
       std::vector<Arguments>{{"--frames", "1"}, {"--resume"}, {"--memory", "1G"}, {"--missing", "skip"}}) {
    Arguments arguments = run_on({one, "-o", file("ao.exr")});
    arguments.insert(arguments.end(), flag.begin(), flag.end());
    expect_refused(arguments, 2, {flag[0], "is one frame"});
  }
  expect_refused(run_on({shot, "-o", out, "--warm-up", "1"}), 2, {"--warm-up 1", "--temporal"});
  expect_refused(run_on({shot, "-o", out, "--temporal", "--warm-up", "2"}), 2,
                 {"--warm-up 2", "none would be written"});
  expect_refused(run_on({shot, "-o", out, "--temporal", "--missing", "hold"}), 2, {"--missing hold", "--temporal"});
  expect_refused(run_on({shot, "-o", out, "--temporal", "--resolution", "half"}), 2, {"--temporal", "--resolution"});
  expect_refused({"run", "normals", shot, "-o", out, "--temporal"}, 2, {"--temporal: normals makes neither"});
  expect_refused({"run", "stereo-ssr", shot, "-o", out, "--temporal"}, 2,
                 {"--temporal: stereo-ssr has no form for sequences; sssr has"});
  expect_refused(run_on({shot, "-o", out, "--json", one}), 2, {"--json", "is also"});
  expect_refused({"plan", "ao", shot}, 1, {"only run, auto, info and compare take the files of a shot"});
}

// --- Cameras and eyes

constexpr const char* own_pose = R"("camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])";

std::string camera_json(double fx) {
  return fmt::format(R"({{"width": 64, "height": 48, "fx": {}, "fy": {}, "cx": 32, "cy": 24, {}}})", fx, fx, own_pose);
}

TEST_F(Shot, CamerasOfEachFrame) {
  for (const int number : {1, 2, 3}) {
    Frame frame = frame_of(number);
    frame.views[0].camera.reset();
    write_frame(path(numbered("shot", number)), frame);
  }
  const auto expect_focal_lengths = [&](const Arguments& more, const std::vector<double>& lengths) {
    const Result result = run(more);
    ASSERT_EQ(result.status, 0) << result.err;
    for (size_t i = 0; i < lengths.size(); ++i)
      EXPECT_NEAR(FrameFile(path(numbered("ao", int(i) + 1)), {}).camera("")->fx, lengths[i], 1e-3) << i;
  };
  for (const int number : {1, 2, 3})
    std::ofstream(path(fmt::format("cam.{:04}.json", number))) << camera_json(40 + number);
  expect_focal_lengths({"--camera", file("cam.####.json")}, {41, 42, 43});
  std::ofstream(path("list.json")) << fmt::format(R"({{"frames": {{"1": {}, "2": {}, "3": {}, "4": {}}}}})",
                                                  camera_json(51), camera_json(52), camera_json(53), camera_json(54));
  expect_focal_lengths({"--camera", file("list.json")}, {51, 52, 53});
  std::ofstream(path("order.json")) << fmt::format(
      R"({{"width": 64, "height": 48, "cx": 32, "cy": 24, "fy": 50, {}, "frames": [{{"fx": 61}}, {{"fx": 62}}, {{"fx": 63}}]}})",
      own_pose);
  expect_focal_lengths({"--camera", file("order.json")}, {61, 62, 63});
  expect_focal_lengths({"--camera", file("cam.0002.json")}, {42, 42, 42});
  for (const int number : {1, 2, 3})
    std::ofstream(path(fmt::format("shot.{:04}.camera.json", number))) << camera_json(70 + number);
  expect_focal_lengths({}, {71, 72, 73});
  for (const std::string& name : files())
    if (name.rfind("ao.", 0) == 0) fs::remove(path(name));
  expect_refused(run_of({"--camera", file("order.json"), "--frames", "1-2"}), 1,
                 {"cameras for 3 frames, and there are 2"});
  fs::remove(path("cam.0002.json"));
  const Result result = run({"--camera", file("cam.####.json")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("1 of 3 frames failed: 2"), std::string::npos) << result.err;
  // One frame by itself takes its camera from the list by its number, and a name without a number has none there.
  const std::string one = file("one.exr");
  ASSERT_EQ(gloam({"run", "hbao+", file("shot.0001.exr"), "-o", one, "--camera", file("list.json")}).err.find("frames"),
            std::string::npos);
  EXPECT_NEAR(FrameFile(one, {}).camera("")->fx, 51, 1e-3);
  expect_refused({"run", "hbao+", file("shot.0001.exr"), "-o", one, "--camera", file("order.json")}, 1,
                 {"holds a camera for each frame"});
  fs::copy(path("shot.0001.exr"), path("still.exr"));
  expect_refused({"run", "hbao+", file("still.exr"), "-o", one, "--camera", file("list.json")}, 1,
                 {"holds a camera for each frame"});
}

TEST_F(Shot, ListOfCamerasIsFoundBesideTheFrames) {
  for (const int number : {1, 2, 3}) {
    Frame frame = frame_of(number);
    frame.views[0].camera.reset();
    write_frame(path(numbered("shot", number)), frame);
  }
  const auto write_list = [&](const std::string& third) {
    std::ofstream(path("shot.camera.json")) << fmt::format(R"({{"frames": {{"1": {}, "2": {}, "{}": {}}}}})",
                                                           camera_json(51), camera_json(52), third, camera_json(53));
  };
  write_list("3");
  ASSERT_EQ(run({}).status, 0);
  for (const int number : {1, 2, 3})
    EXPECT_NEAR(FrameFile(path(numbered("ao", number)), {}).camera("")->fx, 50 + number, 1e-3) << number;
  EXPECT_NEAR(gloam({"info", file("shot.0002.exr"), "--json", "-"}).json()["camera"]["fx"].get<double>(), 52, 1e-3);
  write_list("4");
  expect_refused({"run", "hbao+", file("shot.0003.exr"), "-o", file("one.exr")}, 1, {"has no camera for frame 3"});
}

TEST_F(Shot, AStillTakesItsCameraFromAList) {
  Frame frame = frame_of(2);
  frame.views[0].camera.reset();
  frame.attributes["Frame"] = "0002";  // as Blender writes it
  write_frame(path("still.exr"), frame);
  write_frame(path("hero_v7.exr"), frame);
  write_frame(path("hero.0003.exr"), frame);
  frame.attributes.clear();
  write_frame(path("nameless.exr"), frame);
  const auto write_list = [&](int second) {
    std::ofstream(path("list.json")) << fmt::format(R"({{"frames": {{"1": {}, "2": {}, "3": {}}}}})", camera_json(51),
                                                    camera_json(second), camera_json(second == 51 ? 51 : 53));
  };
  const auto focal_length = [&](const std::string& name, const std::string& note) {
    const Result result = gloam({"run", "hbao+", file(name), "-o", file("one.exr"), "--camera", file("list.json")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find(note), std::string::npos) << result.err;
    return result.status == 0 ? FrameFile(path("one.exr"), {}).camera("")->fx : 0;
  };
  write_list(52);
  EXPECT_NEAR(focal_length("still.exr", "that of frame 2 in list.json, as the header says"), 52, 1e-3);
  EXPECT_NEAR(focal_length("hero_v7.exr", "that of frame 2 in list.json, as the header says"), 52, 1e-3);
  EXPECT_NEAR(focal_length("hero.0003.exr", "as the file's name says; its header says frame 2"), 53, 1e-3);
  expect_refused({"run", "hbao+", file("nameless.exr"), "-o", file("one.exr"), "--camera", file("list.json")}, 1,
                 {"neither the name nor the header of nameless.exr says which frame it is"});
  write_list(51);
  EXPECT_NEAR(focal_length("nameless.exr", "the same for all of its frames"), 51, 1e-3);
}

TEST_F(Shot, TwoEyesInTwoFiles) {
  for (const int number : {1, 2}) {
    for (const char* stem : {"L", "R"}) {
      Frame frame = frame_of(number);
      frame.views[0].camera->pose = Pose{};
      frame.views[0].camera->pose->position.x = *stem == 'R' ? 0.1 : 0;
      write_frame(path(numbered(stem, number)), frame);
    }
  }
  write_frame(path(numbered("L", 3)), frame_of(3));
  const Arguments both = {"run",      "hbao+", file("L.####.exr"), file("R.####.exr"), "-o", file("ao.####.exr"),
                          "--radius", "0.5"};
  expect_refused(both, 1, {"frame 3 is missing", "R.0003.exr"});
  Arguments skipping = both;
  skipping.insert(skipping.end(), {"--missing", "skip"});
  const Result result = gloam(skipping);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("L.####.exr is taken as 'left'"), std::string::npos) << result.err;
  EXPECT_EQ(contents().size(), 2u);
  FrameFile of_shot(path("ao.0002.exr"), {});
  EXPECT_EQ(of_shot.views(), (std::vector<std::string>{"left", "right"}));
  ASSERT_EQ(gloam({"run", "hbao+", file("L.0002.exr"), file("R.0002.exr"), "-o", file("one.exr"), "--radius", "0.5",
                   "--outputs", "ao", "--half"})
                .status,
            0);
  Frame a = of_shot.read({"ao"}), b = FrameFile(path("one.exr"), {}).read({"ao"});
  for (const char* view : {"left", "right"})
    EXPECT_EQ(difference(a.view(view).planes.at("ao"), b.view(view).planes.at("ao")).max, 0) << view;
}

// --- gloam info

TEST_F(Shot, InfoHasALineForEachFrame) {
  make_shot({1, 2, 4, 5});
  write_frame(path(numbered("shot", 4)), frame_of(4, 80, 48));
  write_frame(path(numbered("shot", 5)), small_frame(64, 48, {"depth"}));
  const Result people = gloam({"info", file("shot.####.exr")});
  EXPECT_EQ(people.status, 0) << people.err;
  for (const char* words : {"4 frames, 1 to 5", "missing  3", "differs  size: 80x48 in 4, and mostly 64x48",
                            "differs  plane 'color': not there in 5"})
    EXPECT_NE(people.out.find(words), std::string::npos) << words << "\n" << people.out;
  const nlohmann::json document = gloam({"info", file("shot.####.exr"), "--frames", "1-3", "--json", "-"}).json();
  ASSERT_EQ(document["frames"].size(), 2u);
  EXPECT_EQ(document["frames"][1]["frame"], 2);
  EXPECT_EQ(document["frames"][1]["size"], "64x48");
  EXPECT_EQ(document["missing"], nlohmann::json({3}));
  EXPECT_TRUE(document["differs"].empty());
  std::ofstream(path(numbered("shot", 2))) << "no EXR";
  const Result damaged = gloam({"info", file("shot.####.exr")});
  EXPECT_EQ(damaged.status, 1);
  EXPECT_NE(damaged.out.find("is not an EXR file"), std::string::npos) << damaged.out;
  EXPECT_NE(damaged.err.find("1 of 4 frames cannot be read: 2"), std::string::npos) << damaged.err;
  expect_refused({"info", file("shot.####.exr"), "--picture", file("a.png")}, 2, {"pictures show one frame"});
  expect_refused({"info", file("shot.0001.exr"), "--frames", "1"}, 2, {"--frames", "is one frame"});
}

/// A camera that the user names and that is not used is told, as of one frame, and no success.
TEST_F(Shot, InfoTellsACameraThatIsNotUsed) {
  make_shot({1, 2, 3});
  std::ofstream(path("bad.json")) << "{}";
  for (const char* name : {"bad.json", "none.json"}) {
    const Result result = gloam({"info", file("shot.####.exr"), "--camera", file(name)});
    EXPECT_EQ(result.status, 1) << result.out;
    EXPECT_NE(result.err.find("note: frames 1-3: camera: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("gloam: --camera " + file(name) + ": is not used"), std::string::npos) << result.err;
    EXPECT_NE(result.out.find("none"), std::string::npos) << result.out;
  }
  const Result overruled = gloam({"info", file("shot.####.exr"), "--camera", file("bad.json"), "--fov", "60"});
  EXPECT_EQ(overruled.status, 1) << "as gloam run refuses it";
  EXPECT_EQ(gloam({"info", file("shot.####.exr")}).err, "");
}

}  // namespace
}  // namespace gloam::test::shot_test
