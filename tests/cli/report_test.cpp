// gloam report: the contents of the page, that it works in a browser that opens it from disk, and the page of documentation.
#include <cmath>
#include <opencv2/core.hpp>

#include "cli/browser.h"
#include "picture/picture.h"

namespace gloam::test::report_test {
namespace {

using Json = nlohmann::json;

Json row(const std::string& scene, const std::string& technique, const std::string& preset, double ratio, Json error) {
  return {{"technique", technique},
          {"preset", preset},
          {"settings", {{"radius", 0.5}, {"falloff", "quadratic"}}},
          {"scene", scene},
          {"width", 48},
          {"height", 32},
          {"ms", {{"median", 4 * ratio}, {"min", 3.9 * ratio}, {"max", 4.5 * ratio}}},
          {"passes", Json::array()},
          {"ratio_to_hbao_plus", ratio},
          {"rmse_to_truth", error},
          {"ladder", {{"t0w", nullptr}, {"t1", 0.05}, {"t2", 0.02}, {"t3", 0.01}, {"t4_bias", 0.01}, {"t5", 1e-7}}}};
}

/// Two scenes; the second has neither a truth nor pictures.
Json measurements() {
  Json document = {{"device", "a device"}, {"cpu", "a CPU"},      {"cores", 2},  {"driver", "a driver 1.0"},
                   {"date", "2026-01-31"}, {"commit", "0123abc"}, {"rounds", 9}, {"rays", 64}};
  document["scenes"] = {{{"name", "hall"}, {"size", {48, 32}}, {"radius", 0.5}, {"class", "architecture"}},
                        {{"name", "field"}, {"size", {48, 32}}, {"class", "open"}}};
  document["scenes"][0]["truth_image"] = "images/hall/truth.png";
  document["results"] = {row("hall", "hbao+", "low", 0.6, 0.2),   row("hall", "hbao+", "medium", 1, 0.19),
                         row("hall", "hbao+", "ultra", 5, 0.195), row("hall", "gtao", "low", 0.8, 0.15),
                         row("hall", "gtao", "low", 0.3, 0.17),   row("field", "hbao+", "medium", 1, nullptr)};
  document["results"][4]["variant"] = "half";
  document["results"][1]["own_floor_ms"] = 2.0;
  document["results"][1]["ratio_to_own_floor"] = 2.0;
  document["results"][1]["spent_on"] = {{{"what", "gathers"}, {"share", 0.5}},
                                        {{"what", "the filter"}, {"share", 0.5}}};
  document["results"][0]["image"] = "images/hall/low.png";
  document["results"][1]["image"] = "images/hall/medium.png";
  document["growth"] = {{{"technique", "hbao+"}, {"over", "pixels"}, {"scene", "hall"}, {"exponent", 1.01}}};
  document["skipped"] = {
      {{"technique", "normals"}, {"preset", nullptr}, {"scene", nullptr}, {"why", "makes no </script> ao"}}};
  return document;
}

/// Grey of one value, transparent in the left quarter.
void write_grey(const fs::path& path, int value, int width = 48, int height = 32) {
  cv::Mat picture(height, width, CV_8UC2, cv::Scalar(value, 255));
  picture(cv::Rect(0, 0, width / 4, height)).setTo(cv::Scalar(0, 0));
  write_png(path, picture);
}

int count_of(const std::string& text, const std::string& word) {
  int count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

class Report : public BrowserTest {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(path("out/images/hall"));
    write_grey(path("out/images/hall/truth.png"), 200);
    write_grey(path("out/images/hall/low.png"), 100);
    write_grey(path("out/images/hall/medium.png"), 220);
    write(measurements());
  }

  void write(const Json& document) const { write_text("out/bench.json", document.dump()); }
  void write_text(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  Result report(const Arguments& more = {}) const {
    Arguments arguments = {"report", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }

  /// Opens the page, runs `script` in it once it is drawn, and returns the value of `result`. `width`: of the page in pixels.
  Json in_browser(const std::string& script, int width = 1280) const {
    const std::string begin =
        "const points = () => [...document.querySelectorAll('#scatter .point_marks path')];"
        "const ofShot = (chart) => [...document.querySelectorAll(`#sequence-${chart} .point_marks path`)];"
        "await until(() => points().length + ofShot('error').length > 0);";
    return BrowserTest::in_browser(path("out/report.html"), begin, script, {width, ""});
  }
};

/// The same, if there is a browser.
class ReportInBrowser : public Report {
 protected:
  void SetUp() override {
    if (!has_browser()) GTEST_SKIP() << "no chromium to look with (Debian: chromium)";
    Report::SetUp();
    ASSERT_EQ(report().status, 0);
  }
};

TEST_F(Report, WritesOneFileAndSaysItsSize) {
  const Result result = report();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("report.html: 6 rows, 2 scenes, 3 pictures, "), std::string::npos) << result.out;
  const std::string page = slurp(path("out/report.html"));
  EXPECT_EQ(count_of(page, "id=\"picture-"), 3);
  EXPECT_EQ(count_of(page, "id=\"mask-"), 1);  // the same foreground in all
  for (const char* word : {" src=\"", " href=\"http", "@import", "url(http"})
    EXPECT_EQ(count_of(page, word), 0) << word;
  for (const char* word : {"BSD-3-Clause", "ISC licence", "a CPU", "0123abc", "makes no \\u003c/script> ao"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(path("out"))) left.push_back(entry.path().filename().string());
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (Arguments{"bench.json", "images", "report.html"}));
}

TEST_F(Report, GivesTheFrontsAsJson) {
  const Result result = report({"--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(document["report"], (path("out") / "report.html").string());
  const auto setting = [](const char* preset, const char* variant) {
    return Json{{"technique", "gtao"}, {"preset", preset}, {"variant", variant}};
  };
  ASSERT_EQ(document["scenes"].size(), 2u);
  EXPECT_EQ(document["scenes"][0]["name"], "hall");
  EXPECT_EQ(document["scenes"][0]["front"], Json({setting("low", "half"), setting("low", "")}));
  EXPECT_EQ(document["scenes"][1]["front"], Json::array());
  ASSERT_EQ(document["classes"].size(), 1u);
  EXPECT_EQ(document["classes"][0]["name"], "architecture");
  Json point = setting("low", "half");
  point["scenes_on_front"] = 1;
  point["scenes"] = 1;
  EXPECT_EQ(document["classes"][0]["front"][0], point);
}

// Other techniques compute displays: a class that held both would have means of hardly any technique.
TEST_F(Report, KindsOfItemsOfASetAreClassesOfTheirOwn) {
  Json document = measurements();
  document["scenes"][0]["kind"] = "frame";
  document["scenes"][1] = {
      {"name", "hall-display"}, {"size", {48, 32}}, {"class", "architecture"}, {"kind", "display"}};
  document["results"] = {row("hall", "hbao+", "medium", 1, 0.19),
                         row("hall-display", "lightfield-hbao+", "medium", 1, 0.1)};
  write(document);
  const Result result = report({"--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json classes = result.json()["classes"];
  ASSERT_EQ(classes.size(), 2u);
  for (const auto& [i, name, technique] :
       {std::tuple(0, "architecture", "hbao+"), std::tuple(1, "light-field displays", "lightfield-hbao+")}) {
    EXPECT_EQ(classes[size_t(i)]["name"], name);
    ASSERT_EQ(classes[size_t(i)]["front"].size(), 1u) << name;
    EXPECT_EQ(classes[size_t(i)]["front"][0]["technique"], technique);
  }
}

TEST_F(Report, ReducesPicturesByAveragingWhatIsThere) {
  // The left half is background, then black and white columns alternate: their average is grey, without the background's black.
  cv::Mat stripes(4, 64, CV_8UC2, cv::Scalar(0, 0));
  for (int x = 32; x < 64; ++x) stripes.col(x).setTo(cv::Scalar(x % 2 ? 255 : 0, 255));
  write_png(path("out/images/hall/low.png"), stripes);
  const auto size = [&](const char* width) {
    EXPECT_EQ(report({"--picture-width", width}).status, 0);
    return fs::file_size(path("out/report.html"));
  };
  EXPECT_LT(size("8"), size("0"));
  if (!has_browser()) GTEST_SKIP() << "no chromium to look with (Debian: chromium)";
  ASSERT_EQ(report({"--picture-width", "16"}).status, 0);
  const Json result = in_browser(
      "const p = await loadPicture(data.rows[0].picture); result.size = [p.width, p.height];"
      "result.values = [12, 15].map((i) => p.grey(i)); result.there = [0, 7, 8, 15].map((i) => p.isThere(i));");
  EXPECT_EQ(result["size"], Json({16, 1}));
  for (const Json& value : result["values"]) EXPECT_NEAR(value, 127.5, 1);
  EXPECT_EQ(result["there"], Json({false, false, true, true}));
}

TEST_F(Report, ReducesPicturesTo480PixelsWhereNothingIsSaid) {
  write_grey(path("out/images/hall/low.png"), 100, 1000, 40);
  const auto page = [&](const Arguments& more) {
    EXPECT_EQ(report(more).status, 0);
    return slurp(path("out/report.html"));
  };
  const std::string by_default = page({});
  EXPECT_EQ(by_default, page({"--picture-width", "480"}));
  EXPECT_NE(by_default, page({"--picture-width", "481"}));
}

TEST_F(Report, GoesWithoutPicturesThatCannotBeHad) {
  write_text("out/images/hall/low.png", "no picture");
  fs::remove(path("out/images/hall/medium.png"));
  write_grey(path("secret.png"), 7);
  Json document = measurements();
  document["results"][2]["image"] = "../secret.png";
  document["results"][3]["image"] = path("secret.png").string();
  write(document);
  const Result result = report();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.lines_of_error(), 4) << result.err;
  EXPECT_NE(result.err.find("low.png: cannot be read as PNG"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("medium.png: is no file"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("../secret.png: is not below"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("1 picture,"), std::string::npos) << result.out;
}

TEST_F(Report, ReadsOlderFiles) {
  const Result bench = gloam({"bench", "--all", "-o", path("bench"), "--size", "48x32", "--rays", "16", "--scenes",
                              "plane", "--techniques", "hbao+", "--presets", "low", "--rounds", "1", "--no-growth"});
  ASSERT_EQ(bench.status, 0) << bench.err;
  EXPECT_EQ(gloam({"report", path("bench")}).status, 0);
  write({{"results", {{{"technique", "t"}, {"scene", "s"}, {"ms", {{"median", 1}}}}}}});
  const Result result = report({"--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["scenes"], Json({{{"name", "s"}, {"front", Json::array()}}}));
}

TEST_F(Report, SaysWhatIsWrong) {
  const auto says = [&](const Result& result, int status, const std::string& words) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  says(gloam({"report", path("nowhere")}), 1, "gloam bench -o");
  fs::create_directory(path("empty"));
  says(gloam({"report", path("empty")}), 1, "empty: has no bench.json; 'gloam bench -o");
  says(report({"--picture-width", "-1"}), 2, "--picture-width -1");
  says(report({"--json", path("out/bench.json")}), 2, "--json");
  const auto changed = [&](const char* pointer, const Json& value) {
    Json document = measurements();
    document[Json::json_pointer(pointer)] = value;
    write(document);
    return report();
  };
  says(changed("/results/3/ms/median", "fast"), 1, "bench.json: results[3].ms.median is \"fast\", not a number");
  says(changed("/results/0/technique", nullptr), 1, "results[0].technique is missing");
  says(changed("/results", 7), 1, "results is 7, not a list");
  says(changed("/results", Json::array()), 1, "results is empty");
  says(changed("/scenes/0", "hall"), 1, "scenes[0] is \"hall\", not an object");
  says(changed("/scenes/0/size", {1}), 1, "scenes[0].size");
  says(changed("/results/0/depths", "depth"), 1, "results[0].depths is \"depth\", not a list of texts");
  says(changed("/results/0/spent_on", {{{"what", "x"}}}), 1, "results[0].spent_on[0].share is missing");
  write_text("out/bench.json", "{\"results\": [");
  says(report(), 1, "bench.json: is not JSON");
  write_text("out/bench.json", "[]");
  says(report(), 1, "not an object");
  EXPECT_FALSE(fs::exists(path("out/report.html")));
}

TEST_F(ReportInBrowser, OpensWithTheAnswer) {
  Json document = measurements();
  document["results"].push_back(row("hall", "dp-gtao", "low", 4, 0.05));
  document["results"].back()["depths"] = {"depth", "peel"};
  const std::string script = R"js(
    const words = () => document.getElementById('verdict').textContent;
    result.sections = [...document.querySelectorAll('main > section')].map((section) => section.id).slice(0, 2);
    result.hall = words();
    goTo('field', null);
    result.field = words();
  )js";
  const Json result = in_browser(script);
  EXPECT_EQ(result["sections"], Json({"explorer", "pictures"}));
  EXPECT_EQ(result["hall"],
            "Nearest to the truth on hall is gtao low: error 0.1500, at 0.800\u202f× the time of HBAO+ medium.");
  EXPECT_EQ(result["field"], "There is no truth on field, so nothing is known of errors there.");
  write(document);
  ASSERT_EQ(report().status, 0);
  EXPECT_EQ(
      in_browser(script)["hall"],
      "Nearest to the truth on hall is dp-gtao low: error 0.0500, at 4.00\u202f× the time of HBAO+ medium. It reads "
      "all layers; of what reads one layer, gtao low is nearest: error 0.1500, at 0.800\u202f× the time of HBAO+ "
      "medium.");
}

TEST_F(ReportInBrowser, SaysThatThereIsNoLadder) {
  Json document = measurements();
  for (Json& each : document["results"]) each.erase("ladder");
  write(document);
  ASSERT_EQ(report().status, 0);
  const Json result = in_browser(R"js(
    result.hidden = document.getElementById('ladder-chart').hidden;
    result.words = document.getElementById('ladder-table').textContent;
  )js");
  EXPECT_EQ(result["hidden"], true);
  EXPECT_NE(result["words"].get<std::string>().find("gloam bench --ladder presets measures it"), std::string::npos);
}

TEST_F(ReportInBrowser, DrawsEveryRowAndAsksForNothing) {
  const Json result = in_browser(R"js(
    const drawn = () => points().length;
    result.requests = performance.getEntriesByType('resource').map((entry) => entry.name);
    result.plain = drawn();
    const box = document.querySelector('[data-filter=variant][data-value=half]');
    box.click();
    await until(() => drawn() > 4);
    result.all = drawn();
    document.querySelector('[data-filter=technique][data-value="gtao"]').click();
    await until(() => drawn() < 4);
    result.filtered = drawn();
    result.listed = document.querySelectorAll('#rows-table tbody tr').length;
    document.getElementById('all-scenes').click();
    result.listed_of_all = document.querySelectorAll('#rows-table tbody tr').length;
    result.text = document.body.innerText;
  )js");
  EXPECT_EQ(result["requests"], Json::array());
  EXPECT_EQ(result["plain"], 4);  // of the hall, without the variant
  EXPECT_EQ(result["all"], 5);
  EXPECT_EQ(result["filtered"], 3);
  EXPECT_EQ(result["listed"], 3);
  EXPECT_EQ(result["listed_of_all"], 4);
  const std::string text = result["text"];
  for (const char* words : {"a CPU", "a driver 1.0", "2026-01-31", "0123abc", "not at hand", "makes no </script> ao",
                            "hbao+ medium takes 2.00 times its floor", "no truth, so no front"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST_F(ReportInBrowser, DrawsTheRoofline) {
  const std::string begin = "result.hidden_without = document.getElementById('roofline').hidden;";
  EXPECT_EQ(in_browser(begin)["hidden_without"], true);
  Json document = measurements();
  document["scenes"][0]["peaks"] = {{"copy_gb_per_s", 8}, {"gather_g_per_s", 1}, {"fma_gflops", 100}};
  // 48 x 32 pixels in 0.1 ms: 1000 operations each are 15.36 Gflop/s, 15 % of the peak
  document["results"][1]["passes"] = {
      {{"name", "hbao+/estimate"},
       {"ms", {{"median", 0.1}}},
       {"per_pixel", {{"operations", 1000}, {"loads", 50}, {"bytes_loaded", 200}, {"bytes_stored", 4}}},
       {"bound", {{"by", "reads"}, {"share", 0.768}}}},
      {{"name", "hbao+/uncounted"}, {"ms", {{"median", 0.1}}}, {"per_pixel", nullptr}}};
  write(document);
  ASSERT_EQ(report().status, 0);
  const Json result = in_browser(R"js(
    pick(keyOf(data.rows[1]));
    await until(() => document.querySelectorAll('#roofline-chart .passes path').length);
    result.points = document.querySelectorAll('#roofline-chart .passes path').length;
    result.roofs = document.querySelectorAll('#roofline-chart .roof_lines line').length;
    result.cells = [...document.querySelectorAll('#roofline-table tbody td')].map((cell) => cell.textContent);
    result.remark = document.getElementById('roofline-remark').textContent;
  )js");
  EXPECT_EQ(result["points"], 1);
  EXPECT_EQ(result["roofs"], 3);
  EXPECT_EQ(result["cells"], Json({"hbao+ medium: hbao+/estimate", "0.100", "1000", "204", "15.4", "0.768", "3.13",
                                   "15\u202f%", "77\u202f%", "39\u202f%", "reads, 77\u202f%"}));
  EXPECT_NE(result["remark"].get<std::string>().find("Not counted: hbao+ low."), std::string::npos) << result["remark"];
}

/// With more rows than fit, nothing is under the bar, and the page says that there is more.
TEST_F(ReportInBrowser, LongTablesSayThatTheyScroll) {
  Json document = measurements();
  document["scenes"][0]["peaks"] = {{"copy_gb_per_s", 8}, {"gather_g_per_s", 1}, {"fma_gflops", 100}};
  for (int i = 0; i < 40; ++i)
    document["results"][1]["passes"].push_back(
        {{"name", "hbao+/pass" + std::to_string(i)},
         {"ms", {{"median", 0.1}}},
         {"per_pixel", {{"operations", 1000}, {"loads", 50}, {"bytes_loaded", 200}, {"bytes_stored", 4}}},
         {"bound", {{"by", "reads"}, {"share", 0.768}}}});
  write(document);
  ASSERT_EQ(report().status, 0);
  const std::string script = R"js(
    pick(keyOf(data.rows[1]));
    await until(() => document.querySelectorAll('#roofline-table tbody tr').length > 30);
    const box = document.querySelector('#roofline-table .scroll'), note = document.querySelector('#roofline-table .scrolls');
    await until(() => note.textContent);
    result.note = note.textContent;
    result.hidden_columns = box.scrollWidth - box.clientWidth;
  )js";
  const Json wide = in_browser(script, 1280), narrow = in_browser(script, 500);
  EXPECT_EQ(wide["note"], "The table scrolls: more rows below.");
  EXPECT_EQ(wide["hidden_columns"], 0);
  EXPECT_EQ(narrow["note"], "The table scrolls: more rows below, more columns to the right.");
  EXPECT_GT(narrow["hidden_columns"], 0);
}

/// A shot of two frames, with one technique by itself and over time.
Json shot_measurements() {
  Json rows = Json::array();
  for (const bool temporal : {false, true}) {
    rows.push_back({{"technique", "gtao"},
                    {"preset", "low"},
                    {"temporal", temporal},
                    {"ms", {{"median", 4}, {"min", 3}, {"max", 5}}},
                    {"ratio_to_hbao_plus", temporal ? 1.2 : 0.8},
                    {"rmse", 0.1},
                    {"worst", {{"frame", 2}, {"rmse", 0.11}}},
                    {"ssim", 0.7},
                    {"flicker", temporal ? 0.05 : 0.08}});
  }
  return {{"shot", "hall:</script>"}, {"frames", {1, 2}}, {"size", {48, 32}}, {"truth_change", 0.06}, {"rows", rows}};
}

TEST_F(ReportInBrowser, ShowsAShotBesideScenesAndAlone) {
  Json document = measurements();
  document["sequence"] = shot_measurements();
  for (const bool alone : {false, true}) {
    if (alone) document["results"] = document["scenes"] = Json::array();
    write(document);
    const Result written = report();
    ASSERT_EQ(written.status, 0) << written.err;
    EXPECT_NE(written.out.find("2 rows of a shot"), std::string::npos) << written.out;
    const Json result = in_browser(R"js(
      await until(() => ofShot('error').length && ofShot('flicker').length);
      result.points = [ofShot('error').length, ofShot('flicker').length];
      result.heights = ofShot('flicker').map((path) => path.getBoundingClientRect().top);
      result.rows = document.querySelectorAll('#sequence-table tbody tr').length;
      result.heading = document.querySelector('#sequence h2').innerText;
      result.explorer = document.getElementById('explorer').hidden;
      result.lead = document.getElementById('lead').innerText;
    )js");
    EXPECT_EQ(result["points"], Json({2, 2}));
    EXPECT_GT(result["heights"][1], result["heights"][0]) << "less flicker is lower in the chart";
    EXPECT_EQ(result["rows"], 2);
    EXPECT_NE(result["heading"].get<std::string>().find("hall:</script>, 2 frames"), std::string::npos);
    EXPECT_EQ(result["explorer"], alone);
    EXPECT_EQ(result["lead"].get<std::string>().rfind("2 settings of 1 technique on a shot", 0) == 0, alone);
  }
}

TEST_F(ReportInBrowser, ShowsWhatIsClicked) {
  const Json result = in_browser(R"js(
    const shown = () => [document.getElementById('viewer').dataset.shown, (document.querySelector('#viewer .image') || {}).src];
    // A point is drawn where its row says: found by the figures in its data.
    const point = (preset) => points().find((path) => path.__data__.datum.label === 'hbao+ ' + preset);
    const shows = (name) => until(() => document.getElementById('viewer').dataset.shown === name);
    const centre = () => {
      const canvas = document.querySelector('#viewer canvas');
      return canvas && [...canvas.getContext('2d').getImageData(40, 16, 1, 1).data];
    };
    click(point('low'));
    await shows('hbao+ low');
    result.low = shown();
    result.low_difference = centre();
    result.background = [...document.querySelector('#viewer canvas').getContext('2d').getImageData(2, 16, 1, 1).data];
    result.canvas = [document.querySelector('#viewer canvas').width, document.querySelector('#viewer canvas').height];
    const slider = document.querySelector('#viewer .slider');
    slider.value = 25;
    slider.dispatchEvent(new Event('input'));
    result.wipe = document.querySelector('.wipe').style.getPropertyValue('--at');
    click(point('medium'));
    await shows('hbao+ medium');
    result.medium = shown();
    result.medium_difference = centre();
    result.figures = document.getElementById('picked').innerText;
    click(point('ultra'));
    await shows('hbao+ ultra');
    result.ultra = document.getElementById('viewer').innerText;
    click(point('low'), {shiftKey: true});
    const bars = () => document.querySelectorAll('#ladder-chart .bar_marks path').length;
    await until(() => bars() === 15);
    result.chips = [...document.querySelectorAll('#chosen .chip')].map((chip) => chip.innerText);
    result.bars = bars();
    result.rules = document.querySelectorAll('#ladder-chart .total_rules line').length;
  )js");
  EXPECT_EQ(result["low"][0], "hbao+ low");
  EXPECT_EQ(result["medium"][0], "hbao+ medium");
  EXPECT_NE(result["low"][1], result["medium"][1]);
  EXPECT_EQ(result["canvas"], Json({48, 32}));
  // 100 - 200 is beyond the colours: all blue; 220 - 200 is a little above: more red than blue.
  EXPECT_EQ(result["low_difference"], Json({17, 70, 137, 255}));
  EXPECT_GT(result["medium_difference"][0], result["medium_difference"][2]);
  EXPECT_EQ(result["background"][3], 0);
  EXPECT_EQ(result["wipe"], "25%");
  for (const char* words :
       {"0.1900", "another setting is as fast and as near to the truth, and better in one of the two"})
    EXPECT_NE(result["figures"].get<std::string>().find(words), std::string::npos) << result["figures"];
  EXPECT_NE(result["ultra"].get<std::string>().find("There is no picture of hbao+ ultra"), std::string::npos);
  const size_t compared = result["chips"].size();
  EXPECT_EQ(compared, 3u) << result["chips"];    // the picked one, the initial HBAO+ medium, and the kept one
  EXPECT_EQ(result["bars"], 5 * int(compared));  // t0w and t4_noise are missing
  EXPECT_EQ(result["rules"], int(compared));
}

TEST_F(ReportInBrowser, SwitchesScenesAndAxes) {
  const Json result = in_browser(R"js(
    const press = (place, text) => [...document.querySelectorAll(place + ' button')].find((b) => b.innerText === text).click();
    const titles = () => [...document.querySelectorAll('#scatter .role-axis-title text')].map((t) => t.textContent).join();
    await until(() => titles() !== '');
    result.ratio = titles();
    press('#time-switch', 'in ms');
    await until(() => titles() !== '' && titles() !== result.ratio);
    result.ms = titles();
    press('#scenes', 'field');
    result.drawn = points().length;
    result.remark = document.getElementById('scatter-remark').innerText;
    result.row = document.querySelector('#rows-table tbody tr').innerText;
    press('#scenes', 'hall');
    const column = (n) => [...document.querySelectorAll(`#rows-table tbody td:nth-child(${n})`)].map((cell) => cell.innerText);
    const head = () => [...document.querySelectorAll('#rows-table th button')];
    const rmse = head().findIndex((button) => button.innerText === 'rmse');
    head()[rmse].click();
    result.up = column(rmse + 1);
    head()[rmse].click();
    result.down = column(rmse + 1);
    const floor = head().findIndex((button) => button.innerText === '/ own floor');
    result.floor = [0, 1].map(() => { head()[floor].click(); return column(floor + 1)[0]; });
  )js");
  EXPECT_NE(result["ratio"].get<std::string>().find("HBAO+"), std::string::npos) << result["ratio"];
  EXPECT_NE(result["ms"].get<std::string>().find("ms"), std::string::npos) << result["ms"];
  EXPECT_EQ(result["drawn"], 0);
  EXPECT_NE(result["remark"].get<std::string>().find("no truth for this scene"), std::string::npos) << result["remark"];
  EXPECT_NE(result["row"].get<std::string>().find("hbao+"), std::string::npos) << result["row"];
  EXPECT_EQ(result["up"], Json({"0.1500", "0.1900", "0.1950", "0.2000"}));
  EXPECT_EQ(result["down"], Json({"0.2000", "0.1950", "0.1900", "0.1500"}));
  EXPECT_EQ(result["floor"], Json({"2.00", "2.00"}));  // rows without one are last in both orders
}

TEST_F(ReportInBrowser, GivesEachEffectItsOwnSections) {
  Json document = measurements();
  Json hall = document["scenes"][0], light = row("hall", "indirect", "low", 0.9, 0.03);
  hall["effect"] = light["effect"] = "indirect";
  hall["base"] = {{"name", "black"}, {"rmse_to_truth", 0.0345}, {"bias", -0.01}};
  hall["white"] = 0.5;
  hall["truth_image"] = "images/hall/truth.png";
  light["image"] = "images/hall/low.png";
  document["scenes"].push_back(hall);
  document["results"].push_back(light);
  write(document);
  ASSERT_EQ(report().status, 0);
  const Json result = in_browser(R"js(
    const named = (place) => [...document.querySelectorAll(place)].map((each) => each.innerText);
    const effects = () => [...document.querySelectorAll('#scenes .effect')];
    const rules = () => document.querySelectorAll('#ladder-chart .total_rules line').length;
    const lines = () => document.querySelectorAll('#scatter .base_line line').length;
    await until(() => rules() > 0);
    result.effects = effects().map((button) => button.innerText);
    result.of_ao = [points().length, named('#rows-table tbody tr').length, lines(), rules()];
    effects()[1].click();
    await until(() => points().length === 1 && lines() === 1 && document.getElementById('viewer').dataset.shown === 'indirect low');
    result.of_light = [points().length, named('#rows-table tbody tr').length, lines(), rules()];
    result.base = named('#rows-table tbody tr').pop();
    result.ladder = named('#ladder-table tbody tr');
    result.fronts = named('#class-fronts h3');
    result.range = document.querySelector('#viewer .scale').innerText;
    result.remark = document.getElementById('scatter-remark').innerText;
    document.querySelector('#rows-table tbody tr:last-child').click();
    result.picked = document.getElementById('picked').innerText;
  )js");
  EXPECT_EQ(result["effects"], Json({"ambient occlusion", "indirect"}));
  EXPECT_EQ(result["of_ao"][0], 4);
  EXPECT_EQ(result["of_ao"][1], 4);  // older scenes know no base line
  EXPECT_EQ(result["of_ao"][2], 0);
  EXPECT_EQ(result["of_light"], Json({1, 2, 1, 2}));
  const auto holds = [&](const Json& text, const char* words) {
    EXPECT_NE(text.get<std::string>().find(words), std::string::npos) << text;
  };
  holds(result["base"], "black");
  holds(result["base"], "0.0345");
  ASSERT_EQ(result["ladder"].size(), 2u);
  holds(result["ladder"][1], "black");
  EXPECT_EQ(result["fronts"], Json({"architecture (indirect)"}));
  holds(result["range"], "0.13 darker");  // a quarter of what is shown as white
  holds(result["remark"], "Without a technique (black, dotted) the error is 0.0345");
  holds(result["picked"], "indirect low");  // the base line is nothing to pick
}

TEST_F(ReportInBrowser, FitsWideAndNarrowPages) {
  for (const int width : {1280, 400}) {
    const Json result = in_browser(
        "result.width = innerWidth; result.needs = document.documentElement.scrollWidth;"
        "result.chart = document.querySelector('#scatter svg').getBoundingClientRect().width;",
        width);
    EXPECT_EQ(result["width"], width);
    EXPECT_LE(result["needs"], width);
    EXPECT_GT(result["chart"], width / 2);
  }
}

TEST_F(ReportInBrowser, BearsHundredsOfRows) {
  Json document = measurements();
  for (int i = 0; i < 400; ++i) {
    document["results"].push_back(row("hall", "technique " + std::to_string(i % 20), std::to_string(i / 20),
                                      0.2 + 0.01 * i, 0.05 + 0.3 / (1 + i)));
  }
  write(document);
  ASSERT_EQ(report().status, 0);
  const Json result = in_browser(
      "result.points = points().length;"
      "result.needs = document.documentElement.scrollWidth;");
  EXPECT_EQ(result["points"], 404);
  EXPECT_LE(result["needs"], 1280);
}

// --- The page of documentation

/// Two halls, whose means decide, and a frame of the user's own.
Json documented() {
  Json document = {{"device", "a device"}, {"cpu", "a CPU"},      {"cores", 2},  {"driver", "a driver 1.0"},
                   {"date", "2026-01-31"}, {"commit", "0123abc"}, {"rounds", 9}, {"rays", 64}};
  document["results"] = Json::array();
  for (const char* scene : {"hall", "nave"}) {
    document["scenes"].push_back(
        {{"name", scene}, {"size", {48, 32}}, {"radius", 0.5}, {"class", "architecture"}, {"truth_noise", 0.003}});
    const bool is_hall = scene == std::string("hall");
    const auto add = [&](const char* technique, const char* preset, double ratio, double error,
                         const char* variant = "") {
      Json made = row(scene, technique, preset, ratio, error);
      made["variant"] = variant;
      made["bias"] = is_hall ? 0.03 : -0.01;
      document["results"].push_back(made);
    };
    add("hbao+", "low", 0.6, 0.21);
    add("hbao+", "medium", 1, 0.2);
    add("quick", "medium", 0.3, 0.25);
    add("even", "medium", is_hall ? 0.7 : 1.1, is_hall ? 0.15 : 0.17);
    add("even", "ultra", 4, 0.12);
    add("lucky", "medium", 0.2, is_hall ? 0.01 : 0.9);  // the best and fastest on the hall only
    add("dp-even", "medium", 9, 0.1);
    add("even", "medium", 0.4, 0.22, "half");
    add("even", "medium", 0.2, 0.24, "quarter");
    if (is_hall) add("partial", "medium", 0.1, 0.001);
  }
  return document;
}

Json with_all_sections() {
  Json document = documented();
  for (const char* scene : {"hall", "nave"}) {
    document["converged"].push_back({{"technique", "even"}, {"scene", scene}, {"rmse_to_truth", 0.11}, {"bias", 0.02}});
    document["converged"].push_back(
        {{"technique", "dp-even"}, {"scene", scene}, {"rmse_to_truth", 0.09}, {"bias", 0.01}});
    document["converged"].push_back(
        {{"technique", "quick"}, {"scene", scene}, {"rmse_to_truth", 0.24}, {"bias", -0.1}});
    document["scales"].push_back({{"technique", "even"},
                                  {"scene", scene},
                                  {"from", "480x270"},
                                  {"to", "960x540"},
                                  {"mean_change", scene == std::string("hall") ? -0.012 : 0.003},
                                  {"mae", 0.02}});
  }
  document["planes"] = {{{"technique", "even"}, {"plane", "ao_raw"}, {"least", 0.9956}, {"tilt", 0.0}},
                        {{"technique", "even"},
                         {"plane", "ao_raw"},
                         {"least", 0.9712},
                         {"tilt", 80.0},
                         {"direction", 45.0},
                         {"camera", "perspective"},
                         {"x", 3},
                         {"y", 0}},
                        {{"technique", "even"}, {"plane", "ao"}, {"least", 0.9912}, {"tilt", 60.0}}};
  for (Json& result : document["results"]) {
    if (result["technique"] == "even" && result["variant"] == "") {
      const bool is_medium = result["preset"] == "medium";
      result["ratio_to_own_floor"] = is_medium ? 2.5 : 9.0;
      result["spent_on"] = {{{"what", "gathers"}, {"share", 0.3}},
                            {{"what", "arithmetic of the estimate"}, {"share", 0.6}},
                            {{"what", "smooth/horizontal"}, {"share", 0.04}},
                            {{"what", "smooth/vertical"}, {"share", 0.06}}};
    }
    if (result["technique"] == "quick") result["ratio_to_own_floor"] = 1.2;
    if (result["technique"] == "dp-even") result["ratio_to_own_floor"] = 0.85;
    if (result["technique"] == "hbao+" && result["preset"] == "medium") {
      result["naive"] = {{{"part", "estimate"}, {"ratio", result["scene"] == "hall" ? 0.05 : 0.07}},
                         {{"part", "both"}, {"ratio", 0.1}}};
      result["ratio_to_native"] = 1.1;
    }
  }
  return document;
}

class Documentation : public Report {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directory(path("out"));
    fs::create_directory(path("pictures"));
    write(documented());
  }

  Result documentation(const Arguments& sources, const Arguments& more = {}) const {
    Arguments arguments = {"report"};
    arguments.insert(arguments.end(), sources.begin(), sources.end());
    arguments.insert(arguments.end(), {"--markdown", path("page.md")});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }

  std::string page_of(const Json& document) const {
    write(document);
    const Result result = documentation({path("out")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return slurp(path("page.md"));
  }

  /// Pictures of the truth and of two settings on the hall.
  Json with_pictures() const {
    Json document = documented();
    fs::create_directories(path("out/images/hall"));
    write_grey(path("out/images/hall/truth.png"), 200);
    write_grey(path("out/images/hall/medium.png"), 100);
    write_grey(path("out/images/hall/even.png"), 150);
    document["scenes"][0]["truth_image"] = "images/hall/truth.png";
    document["results"][1]["image"] = "images/hall/medium.png";
    document["results"][3]["image"] = "images/hall/even.png";
    return document;
  }
};

/// The part from a heading to the next one of its level.
std::string section(const std::string& page, const std::string& heading) {
  const size_t from = page.find("\n" + heading + "\n");
  if (from == std::string::npos) return "";
  const std::string rank = heading.substr(0, heading.find(' ') + 1);
  return page.substr(from, page.find("\n" + rank, from + 1) - from);
}

std::vector<std::string> headings(const std::string& page) {
  std::vector<std::string> found;
  std::istringstream stream(page);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("## ")) found.push_back(line.substr(3));
  }
  return found;
}

/// The rows of a table, without its heading.
std::string rows_of(const std::string& text) {
  std::string found;
  std::istringstream stream(text);
  bool below = false;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("|")) below = false;
    if (below) found += line + "\n";
    if (line.starts_with("| ---")) below = true;
  }
  return found;
}

TEST_F(Documentation, SaysWhereItComesFrom) {
  const std::string page = page_of(documented());
  std::istringstream lines(page);
  std::string title, empty, all;
  std::getline(lines, title);
  std::getline(lines, empty);
  for (std::string line; std::getline(lines, line) && !line.empty();) all += line + " ";
  EXPECT_EQ(title, "# How near to the truth");
  EXPECT_EQ(empty, "");
  const std::string folder = path("").parent_path().filename().string();
  for (const std::string& words :
       {std::string("generated from `out/bench.json`"),
        "`gloam report " + folder + "/out --markdown " + folder + "/page.md`",
        std::string(
            "a device (a CPU, 2 cores; a driver 1.0), commit 0123abc, 2026-01-31, 9 rounds, 64 rays per pixel")})
    EXPECT_NE(all.find(words), std::string::npos) << words << "\n" << all;
  EXPECT_EQ(page.find(path("").parent_path().parent_path().string() + "/"),
            std::string::npos);  // of this machine
  EXPECT_EQ(rows_of(page.substr(0, page.find("\n## "))),
            "| hall | architecture | 48x32 | 0.5 | - | .003 |\n"
            "| nave | architecture | 48x32 | 0.5 | - | .003 |\n");
}

TEST_F(Documentation, NamesTheSettingForEachNeed) {
  const std::string needs = section(page_of(documented()), "## Which technique for which need");
  EXPECT_EQ(
      rows_of(needs),
      "| least time | lucky medium | .455 (+.010) | 0.20 |\n"
      "| at most the time of HBAO+ medium | even medium | .160 (+.010) | 0.90 |\n"
      "| at most 2 times that | even medium | .160 (+.010) | 0.90 |\n"
      "| at most 5 times that | even ultra | .120 (+.010) | 4.0 |\n"
      "| nearest to the truth at any price, one layer | even ultra | .120 (+.010) | 4.0 |\n"
      "| nearest to the truth with further layers | dp-even medium | .100 (+.010) | 9.0 |\n"
      "| less than half the time of HBAO+ medium, at a lower resolution | even medium, half | .220 (+.010) | 0.40 |\n");
  EXPECT_NE(needs.find("Over 2 scenes: hall and nave. Left out: 1 setting measured on some"), std::string::npos)
      << needs;
}

TEST_F(Documentation, CountsTheScenesOfAFront) {
  const std::string fronts = section(page_of(documented()), "## The fronts");
  EXPECT_EQ(rows_of(fronts),
            "| lucky medium | .455 (+.010) | 0.20 | 1 of 2 |\n"  // on the hall "partial" beats it
            "| quick medium | .250 (+.010) | 0.30 | 1 of 2 |\n"
            "| hbao+ low | .210 (+.010) | 0.60 | 1 of 2 |\n"
            "| even medium | .160 (+.010) | 0.90 | 1 of 2 |\n"
            "| even ultra | .120 (+.010) | 4.0 | 1 of 2 |\n");
  EXPECT_NE(fronts.find("but not of their mean: hbao+ medium (nave)."), std::string::npos) << fronts;
}

TEST_F(Documentation, ShowsEveryPresetOfAScene) {
  Json document = documented();
  document["results"][4]["samples"] = 72;
  const std::string scenes = section(page_of(document), "## Scene by scene");
  EXPECT_NE(scenes.find("\n| technique | low | medium | ultra |\n"), std::string::npos) << scenes;
  EXPECT_EQ(rows_of(section(scenes, "### hall")),
            "| hbao+ | .210 (+.030), 0.60 | .200 (+.030), 1.0 |  |\n"
            "| quick |  | .250 (+.030), 0.30 |  |\n"
            "| even |  | .150 (+.030), 0.70 | .120 (+.030), 4.0, 72 |\n"
            "| lucky |  | .010 (+.030), 0.20 |  |\n"
            "| partial |  | \\* .001 (+.030), 0.10 |  |\n"
            "| dp-even |  | .100 (+.030), 9.0 |  |\n");
  EXPECT_NE(scenes.find("\n| even |  | \\* .170 (-.010), 1.1 | \\* .120 (-.010), 4.0 |\n"), std::string::npos)
      << scenes;
}

TEST_F(Documentation, SaysWhichPresetsGetWorse) {
  EXPECT_EQ(page_of(documented()).find("## Presets that get worse"), std::string::npos);
  Json document = documented();
  for (Json& row : document["results"]) {
    if (row["technique"] == "even" && row["preset"] == "ultra" && row["scene"] == "hall") row["rmse_to_truth"] = .1512;
  }
  EXPECT_EQ(rows_of(section(page_of(document), "## Presets that get worse")),
            "| even | medium | ultra | hall .150 to .151 | 1 of 2 |\n");
}

TEST_F(Documentation, LeavesOutWhatWasNotMeasured) {
  const std::vector<std::string> least = {"Which technique for which need", "The fronts", "Scene by scene",
                                          "Where the errors come from"};
  EXPECT_EQ(headings(page_of(documented())), least);
  // Without a truth and a ratio there is nothing to choose by.
  EXPECT_EQ(headings(page_of({{"results", {{{"technique", "t"}, {"scene", "s"}, {"ms", {{"median", 1}}}}}}})),
            (std::vector<std::string>{"Scene by scene"}));
  EXPECT_EQ(headings(page_of({{"results", Json::array()}, {"planes", with_all_sections()["planes"]}})),
            (std::vector<std::string>{"Does a plane read open?"}));
}

TEST_F(Documentation, HasASectionForEachMeasurement) {
  const std::string page = page_of(with_all_sections());
  EXPECT_EQ(headings(page),
            (std::vector<std::string>{"Which technique for which need", "The fronts", "Scene by scene", "Converged",
                                      "Where the errors come from", "Time beside the floor",
                                      "Does the look change with the resolution?", "Does a plane read open?",
                                      "Beside other ways to compute it"}));
  EXPECT_EQ(rows_of(section(page, "## Converged")),
            "| hall | **.110** / .090 | .240 |\n"
            "| nave | **.110** / .090 | .240 |\n"
            "| mean | .110 / .090 | .240 |\n"
            "| bias, mean | +.020 / +.010 | -.100 |\n");
  const std::string ladder = rows_of(section(page, "## Where the errors come from"));
  EXPECT_NE(ladder.find("| even medium | - | .050 | .020 | .010 | .010 | - | <.001 | .160 |\n"), std::string::npos)
      << ladder;
  EXPECT_EQ(count_of(ladder, "| even "), 1) << ladder;  // neither its other preset nor its variants
  EXPECT_EQ(rows_of(section(page, "## Time beside the floor")),
            "| quick medium | 1.2 |  |\n"
            "| even medium | 2.5 | arithmetic of the estimate 60 %, gathers 30 %, smooth 10 % |\n"
            "| dp-even medium | 0.85 | no floor: its gathers alone take longer |\n");
  EXPECT_EQ(rows_of(section(page, "## Does the look change with the resolution?")),
            "| even | -.012 | hall, 480x270 to 960x540 | .020 |\n");
  EXPECT_EQ(rows_of(section(page, "## Does a plane read open?")),
            "| even | **.9712** | tilt 80, direction 45, perspective, pixel (3, 0) | .9912 | tilt 60 |\n");
  const std::string others = section(page, "## Beside other ways to compute it");
  EXPECT_NE(others.find("\n| setting | naive kernel, estimate | naive kernel, both | native loop, estimate |\n"),
            std::string::npos)
      << others;
  EXPECT_EQ(rows_of(others), "| hbao+ medium | 0.060 (0.050 to 0.070) | 0.10 | 1.1 |\n");
}

TEST_F(Documentation, TellsLayersByWhatIsReadAndNotByNames) {
  Json document = with_all_sections();
  const auto reads = [](Json each, const char* technique, const Json& depths, int views, double error) {
    each["technique"] = technique;
    each["depths"] = depths;
    each["views"] = views;
    each["rmse_to_truth"] = error;
    return each;
  };
  // Better than all others on one layer, with a similar name.
  for (const char* list : {"results", "converged"}) {
    const Json before = document[list];
    for (const Json& each : before) {
      if (each["technique"] != "quick") continue;
      document[list].push_back(reads(each, "deep", {"depth", "stochastic"}, 1, 0.05));
      document[list].push_back(reads(each, "stereo", {"depth"}, 2, 0.06));
      document[list].push_back(reads(each, "dp-shallow", {"depth"}, 1, 0.1));
      document[list].push_back(reads(each, "sd-old", nullptr, 1, 0.07));  // from a file that does not state its inputs
    }
  }
  const std::string page = page_of(document);
  EXPECT_EQ(rows_of(section(page, "## Converged")),
            "| hall | .110 / .090 | .240 | .050 | .060 | **.100** | .070 |\n"
            "| nave | .110 / .090 | .240 | .050 | .060 | **.100** | .070 |\n"
            "| mean | .110 / .090 | .240 | .050 | .060 | .100 | .070 |\n"
            "| bias, mean | +.020 / +.010 | -.100 | -.100 | -.100 | -.100 | -.100 |\n");
  EXPECT_NE(page.find("| scene | even | quick | deep | stereo | dp-shallow | sd-old |\n"), std::string::npos) << page;
  const std::string needs = rows_of(section(page, "## Which technique for which need"));
  for (const char* line : {"| at most the time of HBAO+ medium | dp-shallow medium |",
                           "| nearest to the truth at any price, one layer | dp-shallow medium |",
                           "| nearest to the truth with further layers | deep medium |"})
    EXPECT_NE(needs.find(line), std::string::npos) << line << "\n" << needs;
  const std::string fronts = section(page, "## The fronts");
  for (const char* other : {"deep", "stereo", "sd-old"}) EXPECT_EQ(fronts.find(other), std::string::npos) << fronts;
}

TEST_F(Documentation, IsMadeOfSeveralFiles) {
  Json kitchen = {{"device", "another device"}, {"results", Json::array()}};
  kitchen["scenes"] = {{{"name", "kitchen"}, {"size", {64, 48}}, {"class", "own"}}};
  kitchen["results"] = {row("kitchen", "hbao+", "medium", 1, 0.3), row("kitchen", "even", "medium", 0.8, 0.2)};
  write_text("kitchen.json", kitchen.dump());
  const Result result = documentation({path("out"), path("kitchen.json")}, {"--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string page = slurp(path("page.md"));
  EXPECT_NE(page.find("kitchen.json` (measured on another device)"), std::string::npos) << page.substr(0, 600);
  EXPECT_NE(section(page, "## Scene by scene").find("### kitchen"), std::string::npos);
  const std::string needs = section(page, "## Which technique for which need");
  EXPECT_NE(needs.find("\n| need | architecture | own frame kitchen |\n"), std::string::npos) << needs;
  EXPECT_NE(needs.find("\n| least time | lucky medium | even medium |\n"), std::string::npos) << needs;
  EXPECT_NE(rows_of(section(needs, "### own frame kitchen")).find("| least time | even medium | .200 | 0.80 |"),
            std::string::npos)
      << needs;
  const Json document = result.json();
  ASSERT_EQ(document["groups"].size(), 2u);
  EXPECT_EQ(document["groups"][1]["scenes"], Json({"kitchen"}));
  EXPECT_EQ(document["groups"][0]["needs"][3]["setting"],
            Json({{"technique", "even"}, {"preset", "ultra"}, {"variant", ""}}));
}

TEST_F(Documentation, DrawsASheetOfPictures) {
  write(with_pictures());
  const Result result = documentation({path("out")}, {"--pictures", path("pictures")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("1 picture\n"), std::string::npos) << result.out;
  const std::string page = slurp(path("page.md"));
  EXPECT_EQ(count_of(page, "!["), 1);
  EXPECT_NE(page.find("](pictures/techniques_hall.png)"), std::string::npos);
  const std::string file = slurp(path("pictures/techniques_hall.png"));
  EXPECT_EQ(int(file.at(24)), 8);  // bits
  EXPECT_EQ(int(file.at(25)), 0);  // grey
  // Tiles of 48x32 at four times their size: the truth, then the nearest first. The left quarter is background.
  const cv::Mat sheet = read_png(path("pictures/techniques_hall.png"));
  const auto grey = [&](int tile, int x) { return int(sheet.at<cv::Vec2b>(84 + 60, 16 + tile * 204 + x)[0]); };
  EXPECT_EQ(grey(0, 120), 200);
  EXPECT_EQ(grey(1, 120), 150);
  EXPECT_EQ(grey(2, 120), 100);
  for (const int tile : {0, 1, 2}) EXPECT_TRUE(grey(tile, 20) == 214 || grey(tile, 20) == 186) << grey(tile, 20);
}

TEST_F(Documentation, KeepsSheetsSmall) {
  Json document = with_pictures();
  for (int i = 0; i < 14; ++i) {
    // Different noise for each: equal tiles would compress.
    const std::string image = "images/hall/" + std::to_string(i) + ".png";
    cv::Mat noise(180, 320, CV_8UC2);
    cv::randu(noise, cv::Scalar::all(0), cv::Scalar::all(256));
    cv::insertChannel(cv::Mat(180, 320, CV_8UC1, cv::Scalar(255)), noise, 1);
    write_png(path("out/" + image), noise);
    document["results"].push_back(row("hall", "t" + std::to_string(i), "medium", 1, 0.2));
    document["results"].back()["image"] = image;
  }
  document["scenes"][0]["truth_image"] = "images/hall/0.png";
  write(document);
  ASSERT_EQ(documentation({path("out")}, {"--pictures", path("pictures")}).status, 0);
  EXPECT_LE(fs::file_size(path("pictures/techniques_hall.png")), 600'000u);
  EXPECT_GT(fs::file_size(path("pictures/techniques_hall.png")), 200'000u);  // and not smaller than necessary
}

TEST_F(Documentation, GoesWithoutPicturesThatCannotBeHad) {
  Json document = with_pictures();
  fs::remove(path("out/images/hall/even.png"));
  document["results"][2]["image"] = "../secret.png";
  write_grey(path("secret.png"), 7);
  write(document);
  Result result = documentation({path("out")}, {"--pictures", path("pictures")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.lines_of_error(), 2) << result.err;
  EXPECT_NE(result.err.find("even.png: is no file"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("../secret.png: is not below"), std::string::npos) << result.err;
  // From the file alone: the sheet of the earlier run stays.
  const std::string before = slurp(path("pictures/techniques_hall.png"));
  fs::remove_all(path("out/images"));
  result = documentation({path("out")}, {"--pictures", path("pictures")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("techniques_hall.png: its pictures are not beside bench.json; kept as it is"),
            std::string::npos)
      << result.err;
  EXPECT_NE(slurp(path("page.md")).find("](pictures/techniques_hall.png)"), std::string::npos);
  EXPECT_EQ(slurp(path("pictures/techniques_hall.png")), before);
  fs::remove(path("pictures/techniques_hall.png"));
  result = documentation({path("out")}, {"--pictures", path("pictures")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("the page goes without pictures"), std::string::npos) << result.err;
  EXPECT_EQ(section(slurp(path("page.md")), "## Pictures"), "");
}

TEST_F(Documentation, LetsNoNameLeaveItsCellOrItsFolder) {
  Json document = with_pictures();
  document["scenes"][0]["name"] = "../../a|b <i>\nx";
  for (Json& result : document["results"]) {
    if (result["scene"] == "hall") result["scene"] = document["scenes"][0]["name"];
  }
  write(document);
  ASSERT_EQ(documentation({path("out")}, {"--pictures", path("pictures")}).status, 0);
  const std::string page = slurp(path("page.md"));
  EXPECT_EQ(page.find("a|b"), std::string::npos);
  EXPECT_EQ(count_of(page, "<i>"), 0);
  std::istringstream stream(rows_of(page));
  for (std::string line; std::getline(stream, line);) EXPECT_TRUE(line.ends_with(" |")) << line;
  EXPECT_EQ(files(), (Arguments{"out", "page.md", "pictures"}));
  EXPECT_TRUE(fs::exists(path("pictures/techniques_______a_b__i__x.png")));
}

TEST_F(Documentation, SaysWhatIsWrongAndWritesNothing) {
  const auto says = [&](const Result& result, int status, const std::string& words) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  write(with_pictures());
  write_text("other.json", "{\"device\": \"x\"}");
  write_text("no.json", "no JSON");
  fs::create_directory(path("empty"));
  const std::string out = path("out"), page = path("page.md"), bench = path("out/bench.json");
  says(gloam({"report", out, out}), 2, "2 folders: report.html is made of one");
  says(gloam({"report", bench}), 2, "bench.json: is a file; report.html is made of the folder");
  says(gloam({"report", out, "--pictures", path("pictures")}), 2, "needs --markdown FILE.md");
  says(documentation({out}, {"--picture-width", "100"}), 2, "--picture-width 100");
  says(documentation({path("nowhere")}), 1, "nowhere: is neither a folder nor a file; 'gloam bench -o DIR'");
  says(documentation({path("empty")}), 1, "empty: has no bench.json");
  says(documentation({out, path("other.json")}), 1, "other.json: results is missing");
  says(documentation({path("no.json")}), 1, "no.json: is not JSON");
  says(documentation({out, bench}), 1, "hbao+ low on the scene 'hall' is also in");
  says(documentation({out}, {"--pictures", path("nowhere")}), 1, "is not a folder; make it first");
  says(documentation({out}, {"--pictures", bench}), 1, "is not a folder; make it first");
  says(documentation({out}, {"--pictures", path("pictures"), "--json", path("pictures/techniques_hall.png")}), 2,
       "name another file");
  says(gloam({"report", out, "--markdown", path("nowhere/page.md")}), 1, "is not a folder");
  says(gloam({"report", out, "--markdown", bench}), 2, "--markdown");
  says(gloam({"report", out, "--pictures", path("pictures"), "--markdown", path("empty")}), 1, "it is a folder");
  Json document = documented();
  document["planes"] = {{{"technique", "even"}, {"plane", "ao"}, {"least", "much"}}};
  write(document);
  says(documentation({out}), 1, "planes[0].least is \"much\", not a number");
  document["planes"] = Json::array();
  document["converged"] = {{{"technique", "even"}}};
  write(document);
  says(documentation({out}), 1, "converged[0].scene is missing");
  document["converged"] = Json::array();
  document["results"] = Json::array();
  write(document);
  says(documentation({out}), 1, "results is empty");
  EXPECT_FALSE(fs::exists(page));
  EXPECT_FALSE(fs::exists(path("out/report.html")));
  EXPECT_TRUE(fs::is_empty(path("pictures")));
}

}  // namespace
}  // namespace gloam::test::report_test
