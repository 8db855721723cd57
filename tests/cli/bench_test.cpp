// gloam bench: the contents of its document, but no times.
#include <cmath>
#include <opencv2/core.hpp>
#include <set>
#include <thread>

#include "cli/gloam_process.h"
#include "picture/picture.h"
#include "support/long.h"

namespace gloam::test::bench_test {
namespace {

using Json = nlohmann::json;

/// A run on a small image of one plane takes seconds.
Arguments small(const fs::path& folder, const Arguments& more = {}, const std::string& scene = "plane") {
  Arguments arguments = {"bench",    "--all", "-o",          folder.string(), "--size",       "96x54",
                         "--rays",   "32",    "--scenes",    scene,           "--techniques", "hbao+",
                         "--rounds", "3",     "--no-growth", "--variants",    "none"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The rounds of a row's ratios, and what their medians are; intervals need more rounds than these.
void expect_rounds(const Json& row, size_t rounds) {
  for (const std::string ratio : {"ratio_to_hbao_plus", "ratio_to_gather_floor", "ratio_to_copy_floor"}) {
    ASSERT_EQ(row[ratio + "_rounds"].size(), rounds) << ratio;
    std::vector<double> sorted = row[ratio + "_rounds"];
    std::sort(sorted.begin(), sorted.end());
    EXPECT_NEAR(row[ratio], sorted[rounds / 2], 1e-5 * sorted[rounds / 2]);
    EXPECT_TRUE(row[ratio + "_interval"].is_null());
    if (!row["cpu_ms"].is_null()) {
      EXPECT_EQ(row["cpu_" + ratio + "_rounds"].size(), rounds) << ratio;
    }
  }
}

const Json* find(const Json& results, const std::string& preset) {
  for (const Json& result : results) {
    if (result["preset"] == preset) return &result;
  }
  return nullptr;
}

/// The row of one variant of a technique.
Json row_of(const Json& document, const std::string& technique, const std::string& variant) {
  for (const Json& row : document["results"]) {
    if (row["technique"] == technique && row["variant"] == variant) return row;
  }
  ADD_FAILURE() << "no row of " << technique << " in the variant '" << variant << "'";
  return {};
}

std::set<std::string> variants_of(const Json& document, const std::string& technique) {
  std::set<std::string> found;
  for (const Json& row : document["results"]) {
    if (row["technique"] == technique && row["variant"] != "") found.insert(row["variant"].get<std::string>());
  }
  return found;
}

std::vector<std::string> spent_on(const Json& row) {
  std::vector<std::string> names;
  for (const Json& share : row["spent_on"]) names.push_back(share["what"]);
  return names;
}

/// `rounds`: how many are kept; 0: none are.
void expect_ms(const Json& ms, size_t rounds = 0) {
  ASSERT_EQ(ms.size(), rounds == 0 ? 3u : 5u);
  if (rounds > 0) {
    EXPECT_EQ(ms["rounds"].size(), rounds);
  }
  EXPECT_GT(ms["min"], 0);
  EXPECT_LE(ms["min"], ms["median"]);
  EXPECT_LE(ms["median"], ms["max"]);
}

/// A long run keeps the scenes that were measured when somebody or something ends it.
TEST_F(Cli, BenchInterruptedKeepsTheScenesThatWereMeasured) {
  const pid_t child = start(
      small(path("out"), {"--ladder", "none", "--no-checks", "--no-images", "--presets", "low"}, "plane,hairball"));
  for (int i = 0; i < 10000 && !fs::exists(path("out/bench.json")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  // The file is there a moment before the command has noted that it is.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGINT);
  const Result result = finish(child);
  EXPECT_EQ(result.status, 128 + SIGINT);
  EXPECT_NE(result.err.find("interrupted; bench.json holds the scenes that were measured"), std::string::npos)
      << result.err;
  const Json document = Json::parse(slurp(path("out/bench.json")));
  ASSERT_EQ(document["scenes"].size(), 1u);
  EXPECT_EQ(document["scenes"][0]["name"], "plane");
  EXPECT_FALSE(document["results"].empty());
  EXPECT_EQ(gloam({"report", path("out")}).status, 0);
}

TEST_F(Cli, BenchWritesTheContractsDocument) {
  const Result result = gloam(small(path("out")));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("t0w model"), std::string::npos) << result.out;
  const Json document = Json::parse(slurp(path("out/bench.json")));
  for (const char* key : {"device", "cpu", "driver", "date", "commit"}) EXPECT_TRUE(document[key].is_string()) << key;
  EXPECT_EQ(document["date"].get<std::string>().size(), 10u);
  EXPECT_TRUE(document["gloam"].is_string());
  EXPECT_TRUE(document["set"].is_null());
  ASSERT_GT(document["command"].size(), 4u);
  EXPECT_EQ(document["command"][0], "gloam");
  EXPECT_EQ(document["command"][1], "bench");
  EXPECT_GT(document["cores"], 0);
  EXPECT_TRUE(document["paper"].is_array());
  EXPECT_TRUE(document["growth"].empty());
  ASSERT_EQ(document["results"].size(), 4u);  // the presets
  for (const Json& row : document["results"]) {
    EXPECT_EQ(row["technique"], "hbao+");
    EXPECT_EQ(row["scene"], "plane");
    EXPECT_EQ(row["width"], 96);
    EXPECT_EQ(row["height"], 54);
    EXPECT_EQ(row["variant"], "");
    EXPECT_EQ(row["depths"], Json({"depth"}));
    EXPECT_EQ(row["views"], 1);
    EXPECT_TRUE(row["settings"].is_object());
    EXPECT_EQ(row["samples"], int(row["settings"]["directions"]) * int(row["settings"]["steps"]));
    expect_ms(row["ms"], 3);
    expect_rounds(row, 3);
    ASSERT_EQ(row["passes"].size(), 2u);
    for (const Json& pass : row["passes"]) expect_ms(pass["ms"]);
    for (const char* key :
         {"ratio_to_gather_floor", "ratio_to_copy_floor", "ratio_to_hbao_plus", "own_floor_ms", "ratio_to_own_floor"}) {
      ASSERT_TRUE(row[key].is_number()) << key;
      EXPECT_GT(row[key], 0) << key;
    }
    EXPECT_LT(row["own_floor_ms"], row["ms"]["median"]);  // without the filter, it reads less
    // In so small an image the gathers alone may take longer.
    const Arguments parts = spent_on(row), filter = {"bilateral/separable"};
    ASSERT_GT(parts.size(), 1u) << row["spent_on"];
    const Arguments estimate(parts.begin(), parts.end() - 1);
    EXPECT_TRUE(estimate == Arguments({"gathers", "arithmetic of the estimate"}) ||
                estimate == Arguments({"estimate, whose gathers alone take longer"}))
        << row["spent_on"];
    EXPECT_EQ(Arguments(parts.end() - 1, parts.end()), filter);
    double spent = 0;
    for (const Json& share : row["spent_on"]) {
      EXPECT_GE(share["share"], 0) << share;
      spent += share["share"].get<double>();
    }
    EXPECT_NEAR(spent, 1, 1e-9);
    EXPECT_TRUE(row["rmse_to_truth"].is_number());
    EXPECT_LE(std::abs(row["bias"].get<double>()), row["rmse_to_truth"]);
    ASSERT_EQ(row["ladder"].size(), 8u);
    EXPECT_TRUE(row["ladder"]["t12"].is_null());  // it has a form over layers
    for (const char* key : {"t0w", "t1", "t2", "t3", "t4_bias", "t4_noise", "t5"}) {
      ASSERT_TRUE(row["ladder"][key].is_number()) << key;
      EXPECT_GE(row["ladder"][key], 0) << key;
      EXPECT_LT(row["ladder"][key], 1e-3) << key;  // a plane is open, for everyone
    }
    // The baselines are HBAO+ with 8 x 4 samples, and compared with that only.
    for (const char* key : {"ratio_to_naive", "ratio_to_native"})
      EXPECT_EQ(row[key].is_number(), row["preset"] == "medium") << key << " " << row["preset"];
  }
  EXPECT_EQ((*find(document["results"], "low"))["settings"]["directions"], 4);
  EXPECT_EQ(files(), Arguments{"out"});
  EXPECT_EQ(document["scenes"][0]["class"], "flat");
}

TEST_F(Cli, BenchMeasuresVariantsOfOnePreset) {
  ONLY_IN_LONG_RUN();
  const Result result =
      gloam({"bench",    "--all",     "-o",           path("out"),   "--size",    "96x54",      "--rays",     "32",
             "--scenes", "courtyard", "--techniques", "hbao+",       "--presets", "low,medium", "--variants", "all",
             "--rounds", "1",         "--no-growth",  "--no-images", "--json",    "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json(), plain = row_of(document, "hbao+", "");
  std::set<std::string> expected = {"half", "quarter", "precise", "half storage"};
  const bool has_double = variants_of(document, "hbao+").count("double") > 0;  // a device may have none
  if (has_double) expected.insert("double");
  EXPECT_EQ(variants_of(document, "hbao+"), expected);
  EXPECT_EQ(document["results"].size(), 2 + expected.size());
  EXPECT_EQ(document["scenes"][0]["class"], "architecture");
  EXPECT_TRUE(document["scenes"][0]["truth_image"].is_null());
  EXPECT_FALSE(fs::exists(path("out/images")));
  for (const std::string& variant : expected) {
    const Json row = row_of(document, "hbao+", variant);
    EXPECT_EQ(row["preset"], "medium") << variant;
    EXPECT_EQ(row["resolution"], variant == "half" || variant == "quarter" ? variant : "full") << variant;
    EXPECT_EQ(row["math"], variant == "precise" || variant == "double" ? "precise" : "fast") << variant;
    EXPECT_EQ(row["real"], variant == "double" ? "double" : "float") << variant;
    EXPECT_EQ(row["storage"], variant == "half storage" ? "half" : "float") << variant;
    EXPECT_TRUE(row["image"].is_null()) << variant;
    EXPECT_TRUE(row["ladder"]["t3"].is_null()) << variant;
  }
  // Their effect shows: little for precision, much for resolution.
  const double error = row_of(document, "hbao+", "half")["rmse_to_truth"], full = plain["rmse_to_truth"];
  EXPECT_GT(std::abs(error - full), 1e-4);
  const double rounded = row_of(document, "hbao+", "half storage")["rmse_to_truth"];
  const double precise = row_of(document, "hbao+", "precise")["rmse_to_truth"];
  EXPECT_NE(rounded, precise);
  EXPECT_NEAR(rounded, precise, 1e-2);
  const std::vector<std::string> half = spent_on(row_of(document, "hbao+", "half"));
  EXPECT_TRUE(std::count(half.begin(), half.end(), "resample/upsample ao")) << Json(half);
}

TEST_F(Cli, BenchSweepsSettings) {
  ONLY_IN_LONG_RUN();
  const auto run = [&](const Arguments& more) {
    Arguments arguments = {"bench",     "--all", "-o",         path("out"), "--size",       "96x54",
                           "--rays",    "32",    "--rounds",   "1",         "--scenes",     "plane",
                           "--presets", "low",   "--variants", "none",      "--techniques", "hbao+,gtao",
                           "--json",    "-",     "--no-growth"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  };
  const Result result = run({"--sweep", "steps=4,9", "--sweep", "directions=1,2", "--ladder", "none"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  const std::set<std::string> product = {"steps=4, directions=1", "steps=4, directions=2", "steps=9, directions=1",
                                         "steps=9, directions=2"};
  EXPECT_EQ(variants_of(document, "hbao+"), product);
  EXPECT_EQ(variants_of(document, "gtao"), product);
  const Json row = row_of(document, "gtao", "steps=9, directions=2");
  EXPECT_EQ(row["preset"], "low");
  EXPECT_EQ(row["settings"]["steps"], 9);
  EXPECT_EQ(row["settings"]["directions"], 2);
  EXPECT_EQ(row["samples"], 36);  // on both sides
  EXPECT_TRUE(row["ladder"]["t3"].is_null());
  EXPECT_EQ(row["image"], "images/plane/gtao_low_steps-9-directions-2.png");
  EXPECT_TRUE(fs::exists(path("out") / row["image"].get<std::string>()));

  // Options that only some techniques have or allow are measured on those.
  const Result some = run({"--sweep", "steps=4,64", "--ladder", "all"});
  ASSERT_EQ(some.status, 0) << some.err;
  const Json one = some.json();
  EXPECT_EQ(variants_of(one, "hbao+"), std::set<std::string>{"steps=4"});
  EXPECT_EQ(variants_of(one, "gtao"), (std::set<std::string>{"steps=4", "steps=64"}));
  EXPECT_TRUE(row_of(one, "gtao", "steps=64")["ladder"]["t3"].is_number());
  ASSERT_EQ(one["skipped"].size(), 1u);
  EXPECT_EQ(one["skipped"][0]["technique"], "hbao+");
  EXPECT_NE(one["skipped"][0]["why"].get<std::string>().find("64"), std::string::npos);
}

TEST_F(Cli, BenchDrawsWhatItMeasured) {
  const Result result =
      gloam(small(path("out"), {"--presets", "low,medium", "--ladder", "none", "--json", "-"}, "hairball"));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  std::set<std::string> names = {document["scenes"][0]["truth_image"].get<std::string>()};
  for (const Json& row : document["results"]) names.insert(row["image"].get<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"images/hairball/truth.png", "images/hairball/hbaoplus_low.png",
                                          "images/hairball/hbaoplus_medium.png"}));
  const Frame frame = FrameFile(path("out/scenes/hairball.exr"), {}).read({"depth"});
  const Channel& depth = frame.views[0].planes.at("depth").channels[0];
  for (const std::string& name : names) {
    const cv::Mat image = read_png(path("out") / name);
    ASSERT_EQ(image.cols, 96) << name;
    ASSERT_EQ(image.rows, 54) << name;
    int transparent = 0, wrong = 0;
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const int alpha = image.at<cv::Vec2b>(y, x)[1];
        transparent += alpha == 0;
        wrong += alpha != (is_background(depth.at(x, y)) ? 0 : 255);
      }
    }
    EXPECT_EQ(wrong, 0) << name;
    EXPECT_GT(transparent, 0) << name;
  }
  // The picture's mean error is the row's bias, within 8 bits.
  const cv::Mat truth = read_png(path("out/images/hairball/truth.png")),
                test = read_png(path("out/images/hairball/hbaoplus_low.png"));
  double sum = 0;
  int count = 0;
  for (int y = 0; y < test.rows; ++y) {
    for (int x = 0; x < test.cols; ++x) {
      if (test.at<cv::Vec2b>(y, x)[1] == 0) continue;
      sum += (test.at<cv::Vec2b>(y, x)[0] - truth.at<cv::Vec2b>(y, x)[0]) / 255.0;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, (*find(document["results"], "low"))["bias"], 1e-3);
  EXPECT_GT(std::abs(sum / count), 5e-3);  // else the line above tests nothing
}

TEST_F(Cli, BenchNamesNoMachine) {
  ASSERT_EQ(gloam(small(path("out"), {"--presets", "medium"})).status, 0);
  const std::string text = slurp(path("out/bench.json"));
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  // A host may be called "x": every text contains that.
  if (std::string(host).size() > 3) {
    EXPECT_EQ(text.find(host), std::string::npos);
  }
  EXPECT_EQ(text.find(folder.string()), std::string::npos);
}

TEST_F(Cli, BenchUsesTruthsAgain) {
  const Arguments arguments = small(path("out"), {"--presets", "medium", "--json", "-"});
  const Result first = gloam(arguments);
  ASSERT_EQ(first.status, 0) << first.err;
  const Json made = {"plane.exr", "plane_ao_ref.exr", "plane_ao_ref_hbao+.exr"};
  EXPECT_EQ(first.json()["scenes"][0]["made"], made);
  EXPECT_TRUE(first.json()["scenes"][0]["reused"].empty());
  const auto written = fs::last_write_time(path("out/scenes/plane_ao_ref.exr"));

  const Result second = gloam(arguments);
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.json()["scenes"][0]["reused"], made);
  EXPECT_NE(second.err.find("plane_ao_ref.exr"), std::string::npos) << second.err;
  EXPECT_EQ(fs::last_write_time(path("out/scenes/plane_ao_ref.exr")), written);

  // Another radius needs other truths of the same frame.
  Arguments wider = arguments;
  wider.insert(wider.end(), {"--radius", "0.75"});
  const Result third = gloam(wider);
  ASSERT_EQ(third.status, 0) << third.err;
  EXPECT_EQ(third.json()["scenes"][0]["reused"], Json({"plane.exr"}));
}

TEST_F(Cli, BenchTracesTheTruthOfAFrameThatWasCapturedAnew) {
  ONLY_IN_LONG_RUN();
  const auto measured = [&](const char* out) {
    const Result result = gloam({"bench",        "--all",       "-o",          path(out), "--frame",    path("f.exr"),
                                 "--techniques", "hbao+",       "--presets",   "low",     "--variants", "none",
                                 "--rays",       "32",          "--rounds",    "1",       "--ladder",   "presets",
                                 "--no-growth",  "--no-checks", "--no-images", "--json",  "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  };
  const auto captured = [&](const char* eye) {
    const Result result =
        gloam({"capture", "gallery", "-o", path("f.exr"), "--size", "96x54", "--eye", eye, "--target", "0,1,0"});
    ASSERT_EQ(result.status, 0) << result.err;
  };
  const Json truths = {"f_ao_ref.exr", "f_ao_ref_hbao+.exr"};
  captured("3,2,1");
  EXPECT_EQ(measured("out")["scenes"][0]["made"], truths);
  EXPECT_EQ(measured("out")["scenes"][0]["reused"], truths);
  captured("2,1.5,2");
  const Json again = measured("out"), fresh = measured("fresh");
  EXPECT_EQ(again["scenes"][0]["made"], truths);
  for (const char* key : {"rmse_to_truth", "bias"})
    EXPECT_EQ(again["results"][0][key], fresh["results"][0][key]) << key;
  EXPECT_EQ(again["results"][0]["ladder"]["t0w"], fresh["results"][0]["ladder"]["t0w"]);
}

TEST_F(Cli, BenchFindsWhereTheErrorComesFrom) {
  ONLY_IN_LONG_RUN();
  const Result result =
      gloam({"bench",    "--all",    "-o",           path("out"),      "--size",    "96x54",    "--rays",     "64",
             "--scenes", "hairball", "--techniques", "hbao+,dp-hbao+", "--presets", "low,high", "--variants", "none",
             "--rounds", "3",        "--no-growth",  "--json",         "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::map<std::string, Json> ladders;
  const Json document = result.json();
  for (const Json& row : document["results"])
    ladders[row["technique"].get<std::string>() + " " + row["preset"].get<std::string>()] = row["ladder"];
  ASSERT_EQ(ladders.size(), 4u);
  const Json &low = ladders["hbao+ low"], &high = ladders["hbao+ high"], &layered = ladders["dp-hbao+ low"];
  EXPECT_GT(low["t0w"], 1e-3);          // its model differs from the truth
  EXPECT_GT(low["t2"], 1e-3);           // strands hide strands
  EXPECT_EQ(layered["t2"], 0);          // ... not from all layers
  EXPECT_GT(low["t3"], high["t3"]);     // more samples, less noise
  EXPECT_EQ(low["t1"], layered["t1"]);  // one truth, one limit
  EXPECT_LT(low["t5"], 1e-3);
}

TEST_F(Cli, BenchClimbsTheLadderOfSweepsOverStochasticDepth) {
  ONLY_IN_LONG_RUN();
  const Result result = gloam({"bench",       "--all",       "-o",           path("out"),    "--size",    "96x54",
                               "--rays",      "16",          "--scenes",     "fence",        "--rounds",  "1",
                               "--ladder",    "all",         "--techniques", "hbao,sd-hbao", "--presets", "low",
                               "--variants",  "none",        "--sweep",      "samples=1,4",  "--sweep",   "bias=0.5",
                               "--no-growth", "--no-checks", "--no-images",  "--json",       "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json(), preset = row_of(document, "sd-hbao", "")["ladder"],
             one = row_of(document, "sd-hbao", "samples=1, bias=0.5")["ladder"],
             four = row_of(document, "sd-hbao", "samples=4, bias=0.5")["ladder"];
  EXPECT_EQ(one["t1"], four["t1"]);    // over all layers it has no samples
  EXPECT_NE(one["t1"], preset["t1"]);  // ... but the same bias
  EXPECT_GT(one["t2"], four["t2"]);    // fewer depths miss more
  EXPECT_TRUE(row_of(document, "hbao", "")["ladder"]["t1"].is_number());
}

TEST_F(Cli, BenchOfOnesOwnFrameAgreesWithRunAndCompare) {
  const Result result =
      gloam({"bench", "--all", "-o", path("out"), "--frame", loggia, "--truth", loggia_truth, "--techniques", "hbao+",
             "--presets", "low", "--variants", "none", "--rounds", "1", "--no-growth", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  ASSERT_EQ(document["results"].size(), 1u);
  const Json& row = document["results"][0];
  EXPECT_EQ(row["scene"], "loggia");
  EXPECT_EQ(document["scenes"][0]["class"], "own");
  EXPECT_TRUE(row["ladder"]["t0w"].is_null());  // no scene to trace
  EXPECT_TRUE(row["ladder"]["t1"].is_null());   // one layer
  EXPECT_GT(row["ladder"]["t3"], 1e-3);
  ASSERT_EQ(
      gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--preset", "low", "--radius", "0.5", "--float"}).status, 0);
  const Json figures = gloam({"compare", path("ao.exr"), loggia_truth, "--json", "-"}).json();
  EXPECT_NEAR(row["rmse_to_truth"], figures["rmse"], 1e-7);
  EXPECT_NEAR(row["bias"], figures["bias"], 1e-7);

  const Result without =
      gloam({"bench", "--all", "-o", path("out"), "--frame", loggia, "--techniques", "hbao+", "--presets", "low",
             "--variants", "none", "--rounds", "1", "--no-growth", "--json", "-"});
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_TRUE(without.json()["results"][0]["rmse_to_truth"].is_null());
}

TEST_F(Cli, BenchMeasuresGrowth) {
  const Result result =
      gloam({"bench",    "--all", "-o",           path("out"), "--size",    "64x36", "--rays",     "32",
             "--scenes", "plane", "--techniques", "dp-hbao+",  "--presets", "low",   "--variants", "none",
             "--rounds", "1",     "--json",       "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::map<std::string, size_t> points;
  const Json document = result.json();
  for (const Json& growth : document["growth"]) {
    EXPECT_EQ(growth["technique"], "dp-hbao+");
    EXPECT_TRUE(growth["exponent"].is_number());
    points[growth["over"]] = growth["points"].size();
  }
  const std::map<std::string, size_t> expected = {
      {"pixels", 5}, {"samples", 4}, {"radius", 5}, {"layers", 4}, {"views", 3}};
  EXPECT_EQ(points, expected);
}

/// The quickest bench of a frame.
Arguments of_frame(const std::string& frame, const std::string& folder, const Arguments& more) {
  Arguments arguments = {"bench",  "--all", "--frame",  frame, "-o",       folder, "--variants", "none",
                         "--rays", "16",    "--rounds", "1",   "--ladder", "none", "--json",     "-"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(Cli, BenchMeasuresGrowthOverThePeeledLayersThatAreRead) {
  ONLY_IN_LONG_RUN();
  const auto growth_over = [&](const Arguments& layers) {
    Arguments capture = {"capture", "colonnade", "-o", path("f.exr"), "--size", "48x27"};
    capture.insert(capture.end(), layers.begin(), layers.end());
    EXPECT_EQ(gloam(capture).status, 0);
    const Result result =
        gloam(of_frame(path("f.exr"), path("out"), {"--techniques", "sd-hbao", "--presets", "low", "--no-images"}));
    EXPECT_EQ(result.status, 0) << result.err;
    const Json document = result.json();
    EXPECT_TRUE(document["skipped"].empty()) << document["skipped"];
    std::set<std::string> over;
    for (const Json& growth : document["growth"]) over.insert(growth["over"].get<std::string>());
    return over;
  };
  const std::set<std::string> always = {"pixels", "samples", "radius", "views"};
  std::set<std::string> with_layers = always;
  with_layers.insert("layers");
  EXPECT_EQ(growth_over({"--peel", "4"}), with_layers);  // stochastic depth is made from them
  EXPECT_EQ(growth_over({"--stochastic", "4"}), always);
  EXPECT_EQ(growth_over({"--peel", "4", "--stochastic", "4"}), always);
}

TEST_F(Cli, BenchSkipsWhatCannotBeMeasuredAndKeepsTheRest) {
  ASSERT_EQ(gloam({"capture", "colonnade", "-o", path("f.exr"), "--size", "48x27", "--stochastic", "2"}).status, 0);
  fs::create_directories(path("out/images/f/truth.png"));
  const Result result =
      gloam(of_frame(path("f.exr"), path("out"),
                     {"--techniques", "sd-hbao,hbao,dp-hbao", "--presets", "low,medium", "--sweep", "samples=2,8"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(variants_of(document, "sd-hbao"), std::set<std::string>{"samples=2"});
  EXPECT_TRUE(find(document["results"], "low"));  // of hbao
  EXPECT_FALSE(document["growth"].empty());
  EXPECT_FALSE(document["scales"].empty());
  EXPECT_TRUE(document["scenes"][0]["truth_image"].is_null());
  EXPECT_NE(result.err.find("no picture of the truth"), std::string::npos) << result.err;
  std::vector<std::string> skipped;
  for (const Json& each : document["skipped"]) {
    const std::string why = each["why"],
                      preset = each["preset"].is_null() ? "" : " " + each["preset"].get<std::string>();
    skipped.push_back(each["technique"].get<std::string>() + preset + ": " + why.substr(0, why.find(',')));
  }
  EXPECT_EQ(skipped,
            Arguments({"sd-hbao low: needs 4 layers of 'stochastic'", "sd-hbao medium: needs 4 layers of 'stochastic'",
                       "sd-hbao medium, samples=8: needs 8 layers of 'stochastic'", "dp-hbao: needs 'peel'",
                       "sd-hbao: growth: needs 4 layers of 'stochastic'"}));
}

TEST_F(Cli, BenchGoesOnWithoutARowWhosePictureCannotBeWritten) {
  fs::create_directories(path("out/images/plane/hbaoplus_low.png"));
  fs::create_directories(path("out/images/plane/hbaoplus_ultra.png"));
  const Result result = gloam(small(path("out"), {"--json", "-"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  ASSERT_EQ(document["results"].size(), 2u);
  EXPECT_EQ(document["results"][0]["preset"], "medium");
  EXPECT_EQ(document["results"][1]["preset"], "high");
  ASSERT_EQ(document["skipped"].size(), 2u);
  for (const Json& skipped : document["skipped"])
    EXPECT_NE(skipped["why"].get<std::string>().find("it is a folder"), std::string::npos) << skipped;
  EXPECT_EQ(document["converged"].size(), 1u);
}

TEST_F(Cli, BenchComparesWithBaselinesOnlyWhereTheyComputeTheSame) {
  ONLY_IN_LONG_RUN();
  Frame flat = small_frame(48, 32, {"depth", "normal"}), pair = small_frame(48, 32, {"depth", "normal"});
  flat.views[0].camera->orthographic = true;
  pair.views[0].name = "left";
  pair.views.push_back(std::move(small_frame(48, 32, {"depth", "normal"}).views[0]));
  pair.views[1].name = "right";
  write_frame(path("flat.exr"), flat);
  write_frame(path("pair.exr"), pair);
  write_frame(path("plain.exr"), small_frame(48, 32, {"depth"}));
  const auto row = [&](const char* file) {
    const Result result =
        gloam({"bench", "--all", "-o", path("out"), "--frame", path(file), "--techniques", "hbao+", "--presets",
               "medium", "--variants", "none", "--rounds", "1", "--no-growth", "--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    const Json document = result.json();
    return document["results"].at(0);
  };
  EXPECT_TRUE(row("plain.exr")["ratio_to_naive"].is_number());  // normals are made from the depth
  EXPECT_TRUE(row("plain.exr")["ratio_to_native"].is_number());
  EXPECT_TRUE(row("flat.exr")["ratio_to_naive"].is_null());
  EXPECT_TRUE(row("flat.exr")["ratio_to_gather_floor"].is_number());
  EXPECT_TRUE(row("pair.exr")["ratio_to_native"].is_null());
  EXPECT_TRUE(row("pair.exr")["ratio_to_gather_floor"].is_null());
  EXPECT_TRUE(row("pair.exr")["ratio_to_hbao_plus"].is_number());
}

TEST_F(Cli, BenchMeasuresOnTheFirstViewWhatMakesNoOther) {
  ONLY_IN_LONG_RUN();
  ASSERT_EQ(gloam({"capture", "colonnade", "-o", path("two.exr"), "--size", "96x54", "--peel", "2", "--stochastic", "4",
                   "--view2", "30"})
                .status,
            0);
  const Result result =
      gloam({"bench", "--all", "-o", path("out"), "--frame", path("two.exr"), "--techniques", "multiview,sd-hbao+",
             "--presets", "low", "--variants", "half", "--rays", "32", "--rounds", "1", "--no-checks", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json(), row = row_of(document, "multiview", ""),
             beside = row_of(document, "sd-hbao+", "");
  EXPECT_TRUE(document["skipped"].empty()) << document["skipped"];
  // The same figures as for the image of gloam run, with the truth of that view.
  ASSERT_EQ(
      gloam({"run", "multiview", path("two.exr"), "-o", path("ao.exr"), "--preset", "low", "--radius", "0.6"}).status,
      0);
  const std::string first = FrameFile(path("two.exr"), {}).read({"depth"}).views[0].name;
  const Frame made = FrameFile(path("ao.exr"), {}).read({"ao"});
  ASSERT_EQ(made.views.size(), 1u);
  Frame truth = FrameFile(path("out/scenes/two_ao_ref.exr"), {}).read({"ao", "depth"});
  ASSERT_EQ(truth.views.size(), 2u);
  const Channel& depth = truth.view(first).planes.at("depth").channels[0];
  double sum = 0, squares = 0;
  int count = 0;
  for (int y = 0; y < 54; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (is_background(depth.at(x, y))) continue;
      const double off = double(made.views[0].planes.at("ao").channels[0].at(x, y)) -
                         truth.view(first).planes.at("ao").channels[0].at(x, y);
      sum += off;
      squares += off * off;
      ++count;
    }
  }
  EXPECT_NEAR(row["rmse_to_truth"], std::sqrt(squares / count), 1e-5);
  EXPECT_NEAR(row["bias"], sum / count, 1e-5);
  for (const Json& each : {row, document["converged"][0]}) {
    EXPECT_EQ(each["technique"], "multiview");
    EXPECT_EQ(each["depths"], Json({"depth", "stochastic"}));
    EXPECT_EQ(each["views"], 2);
  }
  // The others are compared with it on that view alone.
  const Result alone = gloam({"bench",      "--all", "-o",           path("alone"), "--frame",     path("two.exr"),
                              "--view",     first,   "--techniques", "sd-hbao+",    "--presets",   "low",
                              "--variants", "none",  "--rays",       "32",          "--rounds",    "1",
                              "--ladder",   "none",  "--no-growth",  "--no-checks", "--no-images", "--json",
                              "-"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_NEAR(beside["rmse_to_truth"], row_of(alone.json(), "sd-hbao+", "")["rmse_to_truth"], 1e-5);
  EXPECT_GT(row["ladder"]["t3"], 1e-3);
  EXPECT_GT(row["ladder"]["t4_bias"], 1e-3);
  std::set<std::string> over, over_sd;
  for (const Json& growth : document["growth"])
    (growth["technique"] == "multiview" ? over : over_sd).insert(growth["over"].get<std::string>());
  EXPECT_EQ(over, (std::set<std::string>{"pixels", "samples", "radius"}));
  EXPECT_EQ(over_sd, (std::set<std::string>{"pixels", "samples", "radius", "views"}));
}

TEST_F(Cli, BenchSaysWhatIsWrong) {
  struct Wrong {
    Arguments flags;
    std::string says;
    int status = 2;
  };
  const std::vector<Wrong> all = {
      {{"--techniques", "gtoa"}, "did you mean 'gtao'?"},
      {{"--techniques", "normals"}, "none of ao, bounces"},
      {{"--techniques", "indirect", "--effects", "ao"}, "not ao"},
      {{"--effects", "indirekt"}, "did you mean 'indirect'?"},
      {{"--effects", "bounces", "--sequence", "gallery:walk"}, "ambient occlusion alone"},
      {{"--scenes", "plan"}, "did you mean 'plane'?"},
      {{"--presets", "mediun"}, "did you mean 'medium'?"},
      {{"--rounds", "0"}, "--rounds 0"},
      {{"--variants", "quater"}, "did you mean 'quarter'?"},
      {{"--ladder", "some"}, "none, presets and all"},
      {{"--sweep", "steps"}, "--sweep"},
      {{"--sweep", "stepz=4"}, "did you mean 'steps'?"},
      {{"--sweep", "steps=4,,8"}, "--sweep steps"},
      {{"--sweep", "steps=0"}, "steps"},
      {{"--techniques", "hbao+", "--sweep", "steps=99"}, "1 to 32"},
      {{"--techniques", "gtao,bitmask", "--sweep", "thickness=0.1", "--sweep", "fade=0.5"}, "has all parameters"},
      {{"--size", "96"}, "--size 96"},
      {{"--truth", loggia_truth}, "--frame"},
      {{"--fov", "60"}, "--frame"},
      {{"--frame", loggia, "--scenes", "plane"}, "--scenes"},
      {{"--frame", path("missing.exr").string()}, "missing.exr", 1},
  };
  for (const Wrong& wrong : all) {
    Arguments arguments = {"bench", "--all", "-o", path("out")};
    arguments.insert(arguments.end(), wrong.flags.begin(), wrong.flags.end());
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, wrong.status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(wrong.says), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(path("out/bench.json")));
  }
}

TEST_F(Cli, BenchNeedsAFolderThatCanBeWritten) {
  std::ofstream(path("file")) << "not a folder";
  for (const fs::path& out : {path("file"), path("file") / "below"}) {
    const Result result = gloam(small(out));
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find("-o"), std::string::npos) << result.err;
  }
  EXPECT_EQ(slurp(path("file")), "not a folder");
}

TEST_F(Cli, BenchComparesGtaoWithNaiveKernelsThatComputeTheSame) {
  const Result result =
      gloam({"bench",       "--all",     "-o",           path("out"), "--size",      "192x108",  "--rays",
             "1",           "--scenes",  "courtyard",    "--rounds",  "1",           "--ladder", "none",
             "--no-growth", "--presets", "medium",       "--sweep",   "steps=3",     "--sweep",  "directions=2,3",
             "--variants",  "none",      "--techniques", "gtao",      "--no-images", "--json",   "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json(), row = row_of(document, "gtao", "steps=3, directions=3"), naive = row["naive"];
  ASSERT_EQ(naive.size(), 3u) << result.err;
  const std::vector<std::string> parts = {"estimate", "filter", "both"};
  for (size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(naive[i]["part"], parts[i]);
    expect_ms(naive[i]["ms"]);
    expect_ms(naive[i]["naive_ms"]);
    EXPECT_NEAR(naive[i]["ratio"], double(naive[i]["ms"]["median"]) / double(naive[i]["naive_ms"]["median"]), 1e-9);
  }
  // They agree, and not because something was compared with itself.
  for (const size_t i : {0, 2}) {
    EXPECT_LT(naive[i]["mean_difference"], 2e-4) << parts[i];
    EXPECT_GT(naive[i]["mean_difference"], 1e-7) << parts[i];
    EXPECT_GE(naive[i]["max_difference"], naive[i]["mean_difference"]) << parts[i];
  }
  EXPECT_NE(naive[0]["mean_difference"], naive[2]["mean_difference"]);  // the filter took part
  for (const char* key : {"ms", "naive_ms"}) {
    const double estimate = naive[0][key]["median"], filter = naive[1][key]["median"];
    EXPECT_NEAR(estimate + filter, naive[2][key]["median"], 1e-9) << key;
  }
  EXPECT_NEAR(naive[2]["ms"]["median"], row["ms"]["median"], 1e-9);
  EXPECT_EQ(row["ratio_to_naive"], naive[0]["ratio"]);
  EXPECT_NEAR(row["ratio_to_copy_floor"], double(row["ms"]["median"]) / double(row["copy_floor_ms"]), 1e-6);
  // 2 x 3 samples on both sides are not 18.
  EXPECT_TRUE(row_of(document, "gtao", "steps=3, directions=2")["naive"].empty());
}

}  // namespace
}  // namespace gloam::test::bench_test
