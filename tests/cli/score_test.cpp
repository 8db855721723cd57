// gloam score: figures of images, conventions, fits, and what is wrong with them.
#include <limits>

#include "cli/score_fixture.h"
#include "picture/picture.h"
#include "image/png_values.h"

namespace gloam::test::score_test {
namespace {

using Json = nlohmann::json;
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

float same(float v) { return v; }

/// The lines on standard error that begin with a text.
int lines_beginning(const std::string& text, const std::string& with) {
  std::istringstream stream(text);
  int count = 0;
  for (std::string line; std::getline(stream, line);) count += line.rfind(with, 0) == 0;
  return count;
}

class Score : public ScoreTest {};

TEST_F(Score, ATruthIsItsOwnBestImage) {
  write_all(same);
  write_image(items[0], 1, "indirect", same);
  entry({{"name", "other"},
         {"version", "2"},
         {"link", "https://example.org"},
         {"authors", {"A", "B"}},
         {"time_ms", {{"room", 2.5}}},
         {"device", "GPU X"},
         {"settings", {{"samples", 8}}},
         {"licence", "MIT"}});
  const Result result = score_images();
  ASSERT_EQ(result.status, 0) << result.err;
  const Json made = document();
  EXPECT_EQ(made["set"]["name"], "test-1");
  EXPECT_EQ(made["set"]["part"], "public");
  EXPECT_EQ(made["set"]["hash"].get<std::string>().size(), 64u);
  EXPECT_EQ(made["results"].size(), 4u);
  EXPECT_EQ(made["scenes"].size(), 4u);
  for (const Json& each : made["results"]) {
    EXPECT_EQ(each["rmse_to_truth"], 0) << each;
    EXPECT_EQ(each["bias"], 0);
    EXPECT_NEAR(each["ssim"], 1, 1e-9);
    EXPECT_NEAR(each["flip"], 0, 1e-9);
    EXPECT_EQ(each["preset"], "submitted");
    EXPECT_TRUE(each["ratio_to_hbao_plus"].is_null());
    EXPECT_TRUE(fs::exists(path("out") / each["image"].get<std::string>())) << each["image"];
    const Json& submitted = each["submitted"];
    EXPECT_EQ(submitted["version"], "2");
    EXPECT_EQ(submitted["authors"], Json({"A", "B"}));
    EXPECT_EQ(submitted["settings"]["samples"], 8);
    EXPECT_NEAR(submitted["fit"]["rmse_to_truth"], 0, 1e-4);
    EXPECT_TRUE(submitted["whole"].is_null());
  }
  EXPECT_EQ(row("room")["ms"]["median"], 2.5);
  EXPECT_TRUE(row("room")["ms"]["rounds"].empty());
  EXPECT_TRUE(row("walk")["ms"].is_null());
  EXPECT_EQ(row("walk")["kind"], "sequence");
  EXPECT_NEAR(row("walk")["flicker"], 0, 1e-9);
  EXPECT_EQ(row("walk")["submitted"]["frames"], Json({1, 2, 3}));
  EXPECT_TRUE(row("room")["flicker"].is_null());
  EXPECT_GT(row("pair")["inconsistency"], 0);
  EXPECT_EQ(row("pair")["submitted"]["views"].size(), 2u);
  EXPECT_NEAR(row("room", "other", "indirect")["submitted"]["fit"]["scale"], 1, 1e-6);
}

/// The figures are those of gloam compare.
TEST_F(Score, HasTheFiguresOfCompare) {
  write_all([](float v) { return std::min(1.0f, v * v + 0.05f); });
  ASSERT_EQ(score_images().status, 0);
  const Json compared =
      gloam({"compare", path("images/room_ao.exr"), truth("room", "ao"), "--frame", frame("room"), "--json", "-"})
          .json();
  for (const auto& [ours, theirs] : {std::pair("rmse_to_truth", "rmse"), {"bias", "bias"}, {"ssim", "ssim"}})
    EXPECT_NEAR(row("room")[ours], compared[theirs], 1e-7) << ours;
  const Result stereo =
      gloam({"compare", "--stereo", path("images/pair_ao.exr"), "--frame", frame("pair"), "--json", "-"});
  EXPECT_NEAR(row("pair")["inconsistency"], stereo.json()["inconsistency"]["mean"], 1e-7);
  const Json shot = gloam({"compare", path("images/walk.####_ao.exr"), truth("walk", "ao", ".####"), "--frame",
                           frame("walk.####"), "--json", "-"})
                        .json();
  EXPECT_NEAR(row("walk")["flicker"], shot["summary"]["flicker"], 1e-7);
  EXPECT_NEAR(row("walk")["rmse_to_truth"], shot["summary"]["mean"]["rmse"], 1e-7);
}

TEST_F(Score, ConventionsThatAreStatedAreUndone) {
  const auto stored = [](float v) { return 255 * (1 - (1 - 0.8f * (1 - std::pow(v, 2.2f)))); };
  write_all(stored);
  entry({{"name", "other"},
         {"convention",
          {{"inverted", true},
           {"exponent", 2.2},
           {"strength", 0.8},
           {"range", {0, 255}},
           {"radius", 0.7},
           {"falloff", "linear"}}}});
  const Result result = score_images();
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* item : {"room", "walk", "pair"}) EXPECT_NEAR(row(item)["rmse_to_truth"], 0, 2e-5) << item;
  EXPECT_NE(result.err.find("radius is 0.7 and the truth's 0.5"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("falloff is 'linear'"), std::string::npos) << result.err;
  EXPECT_EQ(row("room")["submitted"]["convention"]["range"], Json({0, 255}));
}

TEST_F(Score, ExponentAndStrengthAreFittedOverAllImages) {
  write_all([](float v) { return std::pow(v, 1 / 2.2f); });
  const Result result = score_images();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("looks encoded for a display: to the power of 2."), std::string::npos) << result.err;
  for (const char* item : {"room", "walk", "pair"}) {
    const Json fit = row(item)["submitted"]["fit"];
    EXPECT_NEAR(fit["exponent"], 2.2, 0.02);
    EXPECT_NEAR(fit["strength"], 1, 0.005);
    EXPECT_NEAR(fit["rmse_to_truth"], 0, 2e-3);
    EXPECT_GT(row(item)["rmse_to_truth"], 0.02);
  }
}

TEST_F(Score, LightGetsAFactor) {
  write_image(items[0], 1, "indirect", [](float v) { return 4 * v; });
  const Result result = score_images({"--items", "room"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json fit = row("room", "other", "indirect")["submitted"]["fit"];
  EXPECT_NEAR(fit["scale"], 0.25, 1e-6);
  EXPECT_NEAR(fit["rmse_to_truth"], 0, 1e-7);
  EXPECT_TRUE(fit["exponent"].is_null());
}

TEST_F(Score, ImagesThatLookInvertedAreScoredAndNamed) {
  write_all([](float v) { return 1 - v; });
  const Result result = score_images();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(document()["results"].size(), 3u);
  EXPECT_NE(result.err.find("looks inverted"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("room, walk frame 1, walk frame 2, walk frame 3 and pair"), std::string::npos)
      << result.err;
}

TEST_F(Score, OfImagesOfItemsThatWereNotChosenNothingIsSaid) {
  write_all(same);
  const Result chosen = score_images({"--items", "room"});
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  EXPECT_EQ(chosen.err.find("of no item"), std::string::npos) << chosen.err;
  fs::copy_file(path("images/room_ao.exr"), path("images/stranger.exr"));
  const Result other = score_images({"--items", "room"});
  EXPECT_NE(other.err.find("stranger.exr: its name is of no item"), std::string::npos) << other.err;
}

TEST_F(Score, PicturesOfEightAndSixteenBits) {
  const Frame ao = plane_of(truth("room", "ao"), "ao");
  const Channel& values = ao.views[0].planes.at("ao").channels[0];
  cv::Mat grey(values.layout().height, values.layout().width, CV_8UC1);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) grey.at<unsigned char>(y, x) = to_byte(values.at(x, y));
  }
  write_png(path("images/room.png"), grey);
  ASSERT_EQ(score_images({"--items", "room"}).status, 0);
  // rounding to 1/255: at most half a step, sqrt(1/12) of one in the mean
  EXPECT_GT(row("room")["rmse_to_truth"], 0);
  EXPECT_LT(row("room")["rmse_to_truth"], 0.5 / 255);
  EXPECT_EQ(read_png_values(path("images/room.png")).largest, 255);
}

TEST_F(Score, HalfResolutionIsEnlargedAndComparedAtItsSize) {
  const Frame ao = plane_of(truth("room", "ao"), "ao"), depth = plane_of(frame("room"), "depth");
  const Channel& values = ao.views[0].planes.at("ao").channels[0];
  const Channel& z = depth.views[0].planes.at("depth").channels[0];
  Frame small = small_frame(48, 27, {});
  Plane plane{"ao", {}};
  Channel& means = plane.channels.emplace_back(Layout(48, 27), 1);
  for (int y = 0; y < 27; ++y) {
    for (int x = 0; x < 48; ++x) {
      double sum = 0, count = 0;
      for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
        if (is_background(z.at(2 * x + u, 2 * y + v))) continue;
        sum += values.at(2 * x + u, 2 * y + v), count += 1;
      }
      means.at(x, y) = count > 0 ? float(sum / count) : nan_value;
    }
  }
  small.views[0].planes.emplace("ao", std::move(plane));
  write_frame(path("images/room_ao.exr"), small);
  const Result full = score_images({"--items", "room"});
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.err.find("is 48x27, and 96x54 is needed for a frame of 96x54; \"resolution\": \"half\""),
            std::string::npos)
      << full.err;
  entry({{"name", "other"}, {"convention", {{"resolution", "half"}}}});
  const Result half = score_images({"--items", "room"});
  ASSERT_EQ(half.status, 0) << half.err;
  EXPECT_EQ(row("room")["resolution"], "half");
  EXPECT_NEAR(row("room")["submitted"]["rmse_at_own_size"], 0, 1e-6);
  EXPECT_GT(row("room")["rmse_to_truth"], 0.01);
  EXPECT_LT(row("room")["rmse_to_truth"], 0.2);
}

TEST_F(Score, WhatIsWrongIsOneLineAndTheRestIsScored) {
  write_all(same);
  write_image(items[0], 1, "ao", [](float v) { return 255 * v; });
  fs::remove(path("images/walk.0002_ao.exr"));
  write_image(items[2], 1, "ao", [](float) { return nan_value; });
  const Result result = score_images();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(lines_beginning(result.err, "gloam: "), 4) << result.err;
  EXPECT_NE(result.err.find("gloam: room: left out: " + path("images/room_ao.exr").string() + ": is 0 to 255 on "),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("such as \"range\": [0, 255]"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("gloam: walk frame 2: left out: there is no image of it; walk.0002_ao.exr names one"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("gloam: pair: left out: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" nan at pixel "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("gloam: 3 images left out, 1 item scored"), std::string::npos) << result.err;
  EXPECT_EQ(document()["results"].size(), 1u);
  EXPECT_EQ(row("walk")["submitted"]["missing_frames"], Json({2}));
  EXPECT_EQ(row("walk")["rmse_to_truth"], 0);
}

TEST_F(Score, PicturesThatCannotBeWrittenLeaveTheItemOut) {
  write_all(same);
  fs::create_directories(path("out"));
  std::ofstream(path("out/images")) << "a file";
  const Result result = score_images();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(lines_beginning(result.err, "gloam: room: left out: "), 1) << result.err;
  EXPECT_NE(result.err.find("nothing could be scored"), std::string::npos) << result.err;
}

TEST_F(Score, FilesThatAreNoImagesAreLeftOut) {
  write_all(same);
  std::ofstream(path("images/room_ao.exr")) << "no image";
  std::ofstream(path("images/stray.exr")) << "of no item";
  Frame pair = plane_of(path("images/pair_ao.exr"), "ao");
  pair.views.pop_back();
  write_frame(path("images/pair_ao.exr"), pair);
  const Result result = score_images();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(lines_beginning(result.err, "gloam: room: left out: " + path("images/room_ao.exr").string()), 1)
      << result.err;
  EXPECT_EQ(lines_beginning(result.err, "gloam: pair: left out: "), 1) << result.err;
  EXPECT_NE(result.err.find("no view 'right'"), std::string::npos) << result.err;
  EXPECT_EQ(lines_beginning(result.err, "note: " + path("images/stray.exr").string() + ": its name is of no item"), 1)
      << result.err;
  EXPECT_EQ(document()["results"].size(), 1u);
}

TEST_F(Score, ViewsMayBeFilesOfTheirOwn) {
  Frame both = plane_of(truth("pair", "ao"), "ao");
  for (const size_t i : {0u, 1u}) {
    Frame one = without_planes(both);
    one.views.clear();
    View& view = one.views.emplace_back();
    view.name = "";
    view.planes.emplace("ao", both.views[i].planes.at("ao").clone());
    write_frame(path("images/pair_" + both.views[i].name + ".exr"), one);
  }
  const Result result = score_images({"--items", "pair"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(row("pair")["rmse_to_truth"], 0);
  fs::remove(path("images/pair_right.exr"));
  const Result without = score_images({"--items", "pair"});
  EXPECT_EQ(without.status, 1);
  EXPECT_NE(without.err.find("no image of view right"), std::string::npos) << without.err;
}

TEST_F(Score, JoinsWhatIsThereAndReplacesItself) {
  write_all(same);
  ASSERT_EQ(score_images().status, 0);
  write_all([](float v) { return 0.9f * v; });
  entry({{"name", "another"}});
  ASSERT_EQ(score_images().status, 0);
  EXPECT_EQ(document()["results"].size(), 6u);
  write_all([](float v) { return 0.8f * v; });
  const Result again = score_images();
  ASSERT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("had 3 rows of 'another', which the new ones replace"), std::string::npos) << again.err;
  EXPECT_EQ(document()["results"].size(), 6u);
  EXPECT_EQ(row("room")["rmse_to_truth"], 0);
  EXPECT_GT(row("room", "another")["rmse_to_truth"], 0.1);
  // one item again: the others stay
  ASSERT_EQ(score_images({"--items", "room"}).status, 0);
  EXPECT_EQ(document()["results"].size(), 6u);
}

TEST_F(Score, AnotherSetIsRefused) {
  write_all(same);
  ASSERT_EQ(score_images().status, 0);
  const std::string before = slurp(path("out/bench.json"));
  write_manifest("test-2");
  const Result result = score_images();
  EXPECT_EQ(result.status, 0) << "the items are the same, and so is their hash: " << result.err;
  fs::remove(truth("room", "indirect"));
  ok({"reference", "indirect", frame("room"), "-o", truth("room", "indirect"), "--samples", "64"});
  write_manifest();
  const Result other = score_images();
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(other.lines_of_error(), 1) << other.err;
  EXPECT_NE(other.err.find("another version"), std::string::npos) << other.err;
}

TEST_F(Score, FilesThatAreNotTheSetsAreLeftOut) {
  write_all(same);
  fs::copy_file(frame("walk.0001"), frame("walk.0003"), fs::copy_options::overwrite_existing);
  fs::remove(truth("room", "ao"));
  const Result result = score_images();
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(lines_beginning(result.err, "gloam: walk frame 3: left out: " + frame("walk.0003") + ": is not the set's"),
            1)
      << result.err;
  EXPECT_EQ(lines_beginning(result.err, "gloam: room: left out: " + truth("room", "ao") + ": is missing"), 1)
      << result.err;
  EXPECT_EQ(document()["results"].size(), 2u);
}

TEST_F(Score, FramesOfOnesOwn) {
  write_all([](float v) { return 0.9f * v; });
  const auto own = [&](const Arguments& images, const std::string& frame_file, const std::string& truth_file) {
    Arguments arguments = {"score",    "--json",  path("entry.json"), "--json", "-",        "--frame",
                           frame_file, "--truth", truth_file,         "-o",     path("own")};
    arguments.insert(arguments.end(), images.begin(), images.end());
    return gloam(arguments);
  };
  const Result one = own({path("images/room_ao.exr")}, frame("room"), truth("room", "ao"));
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.json()["results"][0]["scene"], "room");
  EXPECT_LT(one.json()["fit"]["ao"]["rmse"], one.json()["results"][0]["rmse_to_truth"]);
  const Result shot = own({path("images/walk.####_ao.exr")}, frame("walk.####"), truth("walk", "ao", ".####"));
  ASSERT_EQ(shot.status, 0) << shot.err;
  EXPECT_EQ(document("own")["results"].size(), 2u);
  EXPECT_TRUE(document("own")["set"].is_null());
  EXPECT_TRUE(row("walk", "other", "ao", "own")["flicker"].is_number());
  const Result mixed = own({path("images/room_ao.exr")}, frame("walk.####"), truth("walk", "ao", ".####"));
  EXPECT_EQ(mixed.status, 2) << mixed.err;
  EXPECT_EQ(mixed.lines_of_error(), 1) << mixed.err;
}

TEST_F(Score, EntriesAreChecked) {
  write_all(same);
  const std::pair<std::string, std::string> told[] = {
      {R"({})", "name is missing"},
      {R"({"name": "gtao"})", "name is 'gtao', a technique of gloam itself"},
      {R"({"name": ""})", "name is ''"},
      {R"({"nome": "x"})", "no key 'nome' (did you mean 'name'?)"},
      {R"({"name": "x", "effect": "oa"})", "effect is \"oa\"; ao, "},
      {R"({"name": "x", "time_ms": "fast"})", "time_ms is \"fast\"; a number of milliseconds"},
      {R"({"name": "x", "time_ms": -1})", "time_ms is -1; a number from 0 to "},
      {R"({"name": "x", "convention": {"exponent": 0}})", "convention.exponent is 0; a number from 0.01 to 100"},
      {R"({"name": "x", "convention": {"range": [1, 0]}})", "convention.range is [1,0]; a list of two numbers"},
      {R"({"name": "x", "convention": {"resolution": "third"}})",
       "convention.resolution is \"third\"; full, half and quarter"},
      {R"({"name": "x", "convention": {"gamma": 2}})", "no key 'convention.gamma'"},
      {R"({"name": "x", "convention": {"inverted": 1}})", "convention.inverted is 1; true or false"},
      {R"({"name": "x", "effect": "indirect", "convention": {"inverted": true}})",
       "convention.inverted: the effect is 'indirect'"},
      {R"([1])", "the entry is [1], not an object"},
      {R"({"name": "x", "settings": 3})", "settings is 3; an object"},
      {R"(name)", "entry.json"}};
  for (const auto& [text, message] : told) {
    std::ofstream(path("entry.json")) << text;
    const Result result = score_images();
    EXPECT_NE(result.status, 0) << text;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(path("entry.json").string()), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  }
  EXPECT_FALSE(fs::exists(path("out/bench.json")));
}

TEST_F(Score, CommandLinesAreChecked) {
  write_all(same);
  const std::pair<Arguments, std::string> told[] = {
      {{"score", path("images"), "--set", path("set"), "-o", path("out")},
       "--json ENTRY.json is required: what made the images; {\"name\": \"my method\"} is enough"},
      {{"score", "--json", path("entry.json"), "--set", path("set"), "-o", path("out")}, "IMAGES are required"},
      {{"score", path("images"), "--json", path("entry.json"), "-o", path("out")}, "--set DIR is required"},
      {{"score", path("images"), "--json", path("entry.json"), "--set", path("set"), "--fov", "60", "-o", path("out")},
       "--fov"},
      {{"score", path("images"), "--json", path("entry.json"), "--set", path("set"), "--items", "rom", "-o",
        path("out")},
       "--items rom: no such item (did you mean 'room'?)"},
      {{"score", path("images"), "--json", path("entry.json"), "--set", path("set"), "--rounds", "2", "-o",
        path("out")},
       "--rounds: is for --command"},
      {{"score", "--command", "engine {frame}", "--json", path("entry.json"), "--set", path("set"), "-o", path("out")},
       "{frame} and {image}"},
      {{"score", "--command", "engine {frame} {image} {sise}", "--json", path("entry.json"), "--set", path("set"), "-o",
        path("out")},
       "{sise} stands for nothing"},
      {{"score", "--command", "engine {frame} {imag}", "--json", path("entry.json"), "--set", path("set"), "-o",
        path("out")},
       "{imag}"},
      {{"score", "--command", "engine '{frame} {image}", "--json", path("entry.json"), "--set", path("set"), "-o",
        path("out")},
       "the quote ' has no end"},
      {{"score", "--command", "engine {frame} > {image}", "--json", path("entry.json"), "--set", path("set"), "-o",
        path("out")},
       "'>' is for a shell"}};
  for (const auto& [arguments, message] : told) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  }
}

TEST_F(Score, MeasuringLeavesWhatWasSubmitted) {
  write_image(items[0], 1, "ao", same, "theirs");
  const Arguments own = {"--frame", frame("room"), "--truth", truth("room", "ao")};
  const auto with_own = [&](Arguments words) {
    words.insert(words.end(), own.begin(), own.end());
    return words;
  };
  ok(with_own({"score", path("images/theirs.exr"), "--json", path("entry.json"), "-o", path("out")}));
  for (int run = 0; run < 2; ++run) {
    const Result measured =
        gloam(with_own({"bench", "-o", path("out"), "--techniques", "ssao", "--presets", "low", "--rounds", "1"}));
    ASSERT_EQ(measured.status, 0) << measured.err;
    EXPECT_FALSE(row("room").is_null());
    EXPECT_FALSE(row("room", "ssao").is_null());
    EXPECT_EQ(lines_beginning(measured.err, "note: " + path("out/bench.json").string() + ": had "), run);
  }
  const Result other = gloam(with_own(
      {"bench", "-o", path("out"), "--techniques", "ssao", "--presets", "low", "--rounds", "1", "--radius", "2"}));
  EXPECT_NE(other.status, 0);
  EXPECT_FALSE(row("room").is_null());
}

TEST_F(Score, FourAtOnceLoseNothing) {
  write_all(same);
  std::vector<pid_t> running;
  for (int i = 1; i <= 4; ++i) {
    const std::string name = "m" + std::to_string(i);
    std::ofstream(path(name + ".json")) << Json{{"name", name}}.dump();
    running.push_back(start({"score", path("images"), "--json", path(name + ".json"), "--set", path("set"), "-o",
                             path("out"), "--no-images"}));
  }
  for (const pid_t child : running) EXPECT_EQ(finish(child).status, 0) << slurp(path("stderr"));
  for (int i = 1; i <= 4; ++i) {
    for (const ScoreItem& item : items)
      EXPECT_FALSE(row(item.name, "m" + std::to_string(i)).is_null()) << item.name << i;
  }
}

/// A picture whose header states far more pixels than its frame has, in a file of a few bytes.
TEST_F(Score, APictureOfAnotherSizeIsLeftOutBeforeItIsDecoded) {
  write_all(same);
  fs::remove(path("images/room_ao.exr"));
  write_png(path("images/room_ao.png"), cv::Mat(8000, 8000, CV_8UC1, cv::Scalar(9)));
  const Result result =
      finish(start({"score", path("images"), "--json", path("entry.json"), "--set", path("set"), "-o", path("out")}, {},
                   {.address_space = 1 << 29, .seconds = 200}));
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.err.find("room_ao.png: is 8000x8000, and 96x54 is needed"), std::string::npos) << result.err;
  EXPECT_TRUE(row("room").is_null());
  EXPECT_FALSE(row("walk").is_null());
  EXPECT_FALSE(row("pair").is_null());
}

TEST_F(Score, AnImageThatTakesTooMuchMemoryIsLeftOut) {
  write_all(same);
  const Result result = score_images({"--limit-memory", "48M"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.err.find("--limit-memory 48M allows 48 MiB"), std::string::npos) << result.err;
  EXPECT_EQ(score_images({"--limit-memory", "1G"}).status, 0);
}

}  // namespace
}  // namespace gloam::test::score_test
