// gloam leaderboard: its tables, what it refuses, and that its page works in a browser that opens it from disk.
#include <fmt/ranges.h>

#include <opencv2/core.hpp>

#include "cli/browser.h"
#include "picture/picture.h"

namespace gloam::test::leaderboard_test {
namespace {

using Json = nlohmann::json;

const char* const hash_a = "aaaaaaaaaaaaaaaaaaaa";

Json row(const std::string& technique, const std::string& item, const std::string& kind, double error, double ratio) {
  return {{"technique", technique},
          {"preset", "medium"},
          {"scene", item},
          {"kind", kind},
          {"width", 48},
          {"height", 32},
          {"settings", {{"radius", 0.5}, {"outside", "border"}}},
          {"ms", {{"median", 4 * ratio}}},
          {"ratio_to_hbao_plus", ratio},
          {"rmse_to_truth", error},
          {"ssim", 1 - error},
          {"flip", error / 2}};
}

Json scene(const std::string& name, const std::string& kind) {
  return {{"name", name},     {"kind", kind},  {"class", "architecture"},
          {"size", {48, 32}}, {"radius", 0.5}, {"truth_image", "images/" + name + "/truth.png"}};
}

/// Two techniques on two items, a third on one of them, and a submitted method.
Json measurements(const std::string& device = "a device") {
  Json document = {{"device", device},
                   {"cpu", "a CPU"},
                   {"driver", "a driver"},
                   {"date", "2026-01-31"},
                   {"commit", "0123abc"},
                   {"gloam", "0.9"},
                   {"command", {"gloam", "bench", "--set", "my sets/test-1", "-o", "out"}},
                   {"set", {{"name", "test-1"}, {"part", "public"}, {"seed", nullptr}, {"hash", hash_a}}},
                   {"scenes", {scene("hall", "frame"), scene("walk", "sequence")}}};
  Json other = {
      {"technique", "Engine <b>AO</b>"},
      {"preset", "submitted"},
      {"scene", "hall"},
      {"kind", "frame"},
      {"ms", {{"median", 2.5}}},
      {"rmse_to_truth", 0.15},
      {"ssim", 0.8},
      {"flip", 0.2},
      {"image", "images/hall/other.png"},
      {"submitted",
       {{"name", "Engine <b>AO</b>"},
        {"version", "7"},
        {"link", "https://example.org/ao"},
        {"time_ms", 2.5},
        {"device", "their device"},
        {"scored_by", {"gloam", "score", "images"}},
        {"fit", {{"exponent", 1.5}, {"strength", 0.9}, {"rmse_to_truth", 0.05}, {"ssim", 0.97}, {"flip", 0.02}}}}}};
  Json other_walk = other;
  other_walk["scene"] = "walk";
  other_walk["kind"] = "sequence";
  other_walk["rmse_to_truth"] = 0.17;
  other_walk["submitted"]["fit"]["rmse_to_truth"] = 0.07;
  other_walk.erase("image");
  document["results"] = {row("hbao+", "hall", "frame", 0.2, 1),
                         row("hbao+", "walk", "sequence", 0.24, 1),
                         row("gtao", "hall", "frame", 0.1, 1.5),
                         row("gtao", "walk", "sequence", 0.14, 1.7),
                         row("ssao", "walk", "sequence", 0.02, 0.5),
                         other,
                         other_walk};
  document["results"][1]["flicker"] = 0.03;
  document["results"][3]["flicker"] = 0.01;
  document["results"][0]["image"] = "images/hall/hbao+.png";
  document["results"][2]["image"] = "images/hall/gtao.png";
  Json half = row("gtao", "hall", "frame", 0.12, 0.4);
  half["variant"] = half["resolution"] = "half";
  document["results"].push_back(half);
  return document;
}

class Leaderboard : public BrowserTest {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(path("results"));
  }

  void write(const std::string& name, const Json& document) const {
    fs::create_directories(path("results/" + name).parent_path());
    std::ofstream(path("results/" + name)) << document.dump();
  }
  Result leaderboard(const Arguments& more = {"--json", "-"}) const {
    Arguments arguments = {"leaderboard", path("results")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  void says(const std::string& words) const {
    const Result result = leaderboard();
    EXPECT_EQ(result.status, 1) << words << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  }

  /// The row of a technique in a choice of the first effect of a board; null if there is none.
  static Json row_of(const Json& document, const std::string& choice, const std::string& technique,
                     const std::string& variant = "", const std::string& device = "", size_t board = 0) {
    const Json& table = document["boards"][board]["effects"][0];
    for (const Json& each : table["choices"]) {
      if (each["what"] != choice && each["name"] != choice) continue;
      for (const Json& found : each["rows"]) {
        const Json& entry = table["entries"][found["entry"].get<size_t>()];
        if (entry["technique"] == technique && entry["variant"] == variant &&
            (device.empty() || entry["device"] == device)) {
          Json whole = found;
          whole["of"] = entry;
          return whole;
        }
      }
    }
    return nullptr;
  }
};

TEST_F(Leaderboard, TakesMeansOverTheSameItemsOfEveryMethod) {
  write("a.json", measurements());
  const Result result = leaderboard();
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  const Json gtao = row_of(document, "all", "gtao");
  EXPECT_NEAR(gtao["error"], 0.12, 1e-12);
  EXPECT_NEAR(gtao["ssim"], 0.88, 1e-12);
  EXPECT_NEAR(gtao["flip"], 0.06, 1e-12);
  EXPECT_NEAR(gtao["ratio"], 1.6, 1e-12);
  EXPECT_NEAR(gtao["flicker"], 0.01, 1e-12) << "over the sequence alone, as of the others";
  EXPECT_EQ(gtao["items"], 2);
  // ssao was measured on the easier item alone: its mean would win
  const Json ssao = row_of(document, "all", "ssao");
  EXPECT_EQ(ssao["items"], 1);
  for (const char* figure : {"error", "ssim", "flip", "ratio"}) EXPECT_FALSE(ssao.contains(figure)) << figure;
  EXPECT_NEAR(row_of(document, "sequence", "ssao")["error"], 0.02, 1e-12);
  EXPECT_TRUE(row_of(document, "frame", "ssao").is_null());
  EXPECT_FALSE(row_of(document, "frame", "gtao").contains("flicker"));
  EXPECT_NEAR(row_of(document, "frame", "gtao", "half")["ratio"], 0.4, 1e-12);
}

TEST_F(Leaderboard, SetsSubmittedTimesApartAndGivesTheBestFit) {
  Json document = measurements();
  document["results"][5]["submitted"]["whole"] = document["results"][6]["submitted"]["whole"] = {{"ratio", 3}};
  write("a.json", document);
  const Json other = row_of(leaderboard().json(), "all", "Engine <b>AO</b>");
  EXPECT_NEAR(other["error"], 0.16, 1e-12);
  EXPECT_NEAR(other["fit_error"], 0.06, 1e-12);
  EXPECT_NEAR(other["fit_ssim"], 0.97, 1e-12);
  EXPECT_NEAR(other["stated_ms"], 2.5, 1e-12);
  EXPECT_NEAR(other["whole_ratio"], 3, 1e-12);
  EXPECT_FALSE(other.contains("ratio")) << "nothing of it was timed beside HBAO+";
  EXPECT_EQ(other["of"]["submitted"]["link"], "https://example.org/ao");
  EXPECT_EQ(other["of"]["device"], "their device");
  document["results"][5]["submitted"]["link"] = document["results"][6]["submitted"]["link"] = "javascript:alert(1)";
  write("a.json", document);
  EXPECT_EQ(row_of(leaderboard().json(), "all", "Engine <b>AO</b>")["of"]["submitted"]["link"], "")
      << "could run a script";
}

TEST_F(Leaderboard, KeepsDevicesAndSetsApart) {
  write("a.json", measurements());
  Json second = measurements("another device");
  second["results"].erase(second["results"].begin() + 5, second["results"].begin() + 7);  // submitted once
  second["results"][2]["ratio_to_hbao_plus"] = 0.5;
  write("b/bench.json", second);
  Json seeded = second;
  seeded["set"] = {{"name", "test-1"}, {"part", "seeded"}, {"seed", 7}, {"hash", "bbbb"}};
  write("c.json", seeded);
  Json own = second;
  own["set"] = nullptr;
  write("d.json", own);
  const Result result = leaderboard();
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  ASSERT_EQ(document["boards"].size(), 3u);
  EXPECT_EQ(document["boards"][0]["title"], "test-1");
  EXPECT_EQ(document["boards"][1]["title"], "test-1, seeded part (seed 7)");
  EXPECT_EQ(document["boards"][2]["title"], "frames without a set");
  EXPECT_NEAR(row_of(document, "all", "gtao", "", "a device")["ratio"], 1.6, 1e-12);
  EXPECT_NEAR(row_of(document, "all", "gtao", "", "another device")["ratio"], 1.1, 1e-12);
  EXPECT_EQ(document["files"][1]["file"], "b/bench.json");
  EXPECT_EQ(document["files"][1]["set"]["hash"], hash_a);
}

TEST_F(Leaderboard, CountsHardCasesThatAreHeld) {
  write("a.json", measurements());
  const auto finding = [](const char* technique, int number, bool held) {
    return Json{{"technique", technique}, {"case", number}, {"what", "x"}, {"held", held}};
  };
  write("hard.json",
        {{"device", "a device"},
         {"failed", 1},
         {"cases",
          {finding("gtao", 1, true), finding("gtao", 2, true), finding("gtao", 2, false), finding("hbao+", 1, true)}}});
  Json document = leaderboard().json();
  EXPECT_EQ(row_of(document, "all", "gtao")["of"]["held"], 1);
  EXPECT_EQ(row_of(document, "all", "gtao")["of"]["cases"], 2);
  EXPECT_EQ(row_of(document, "all", "hbao+")["of"]["held"], 1);
  EXPECT_TRUE(row_of(document, "sequence", "ssao")["of"]["held"].is_null());
  Json with = measurements();
  with["stability"] = {{"gtao", {{"held", 19}, {"cases", 20}}}};
  write("a.json", with);
  says("hard.json: hard cases of gtao on a device are also in a.json; leave one of the two files out");
  fs::remove(path("results/hard.json"));
  EXPECT_EQ(row_of(leaderboard().json(), "all", "gtao")["of"]["held"], 19);
}

TEST_F(Leaderboard, GivesTheCommandOfEachRow) {
  write("a.json", measurements());
  const Json document = leaderboard().json();
  const Json& table = document["boards"][0]["effects"][0];
  std::vector<std::string> commands;
  for (const Json& each : table["rows"])
    commands.push_back(each["run"].is_null() ? "" : each["run"].get<std::string>());
  const auto has = [&](const std::string& command) {
    return std::count(commands.begin(), commands.end(), command) == 1;
  };
  EXPECT_TRUE(has(
      "gloam run gtao test-1/frames/hall.exr -o gtao_hall.exr --preset medium --set outside=border --set radius=0.5"))
      << fmt::format("{}", fmt::join(commands, "\n"));
  EXPECT_TRUE(has(
      "gloam run gtao test-1/frames/hall.exr -o gtao_hall.exr --preset medium --resolution half --set outside=border "
      "--set radius=0.5"));
  EXPECT_TRUE(
      has("gloam run ssao 'test-1/frames/walk.####.exr' -o 'ssao_walk.####.exr' --preset medium --set outside=border "
          "--set radius=0.5"));
  EXPECT_EQ(document["files"][0]["measured_by"], "gloam bench --set 'my sets/test-1' -o out");
  EXPECT_EQ(table["rows"].back()["measured_by"], "gloam score images");
}

TEST_F(Leaderboard, ReadsNoLeaderboard) {
  write("a.json", measurements());
  for (int time = 0; time < 3; ++time) {
    const Result result = leaderboard({"--json", path("results/table.json")});
    ASSERT_EQ(result.status, 0) << time << ": " << result.err;
    EXPECT_EQ(Json::parse(slurp(path("results/table.json")))["files"].size(), 1u);
  }
  fs::remove(path("results/a.json"));
  says("results: holds an earlier leaderboard alone");
}

TEST_F(Leaderboard, SaysWhatIsWrong) {
  says("results: holds no results, neither *.json nor */bench.json");
  EXPECT_NE(gloam({"leaderboard", path("nowhere")}).err.find("nowhere: is not a folder"), std::string::npos);
  std::ofstream(path("results/a.json")) << "{\"results\": [";
  says("a.json: is not JSON");
  write("a.json", {{"tables", 1}});
  says("a.json: holds neither results of gloam bench or gloam score nor hard cases");
  write("a.json", {{"cases", Json::array()}, {"failed", 0}});
  says("results: holds hard cases alone");
  write("a.json", {{"cases", {{{"technique", "gtao"}, {"case", 1}}}}, {"failed", 0}});
  says("a.json: cases[0].held is missing; remove the file, and gloam stress makes it anew");
  Json document = measurements();
  document["results"][0]["rmse_to_truth"] = "small";
  write("a.json", document);
  says("a.json: results[0].rmse_to_truth is \"small\", not a number");
  write("a.json", measurements());
  write("b.json", measurements());
  says("b.json: hbao+ medium on 'hall' on a device is also in ");
  document = measurements("another device");
  document["results"].erase(document["results"].begin() + 5, document["results"].begin() + 7);
  document["set"]["hash"] = "bbbbbbbbbbbbbbb";
  write("b.json", document);
  says("b.json: is of the set test-1 with the hash bbbbbbbbbbbb, and ");
  document["set"]["hash"] = hash_a;
  document["scenes"][0]["radius"] = 0.7;
  write("b.json", document);
  says("b.json: 'hall' has the radius 0.7, and 0.5 in ");
  EXPECT_FALSE(fs::exists(path("results/leaderboard.html")));
  fs::remove(path("results/b.json"));
  const Result over = leaderboard({"-o", path("results/a.json")});
  EXPECT_EQ(over.status, 2);
  EXPECT_EQ(over.lines_of_error(), 1) << over.err;
}

TEST_F(Leaderboard, SaysOnceWhereAFileHasNoPictures) {
  write("a.json", measurements());
  const Result result = leaderboard({});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("a.json: there is no images/ beside it"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("leaderboard.html: from 1 file, 4 methods, 2 items, 0 pictures, "), std::string::npos)
      << result.out;
  const std::string page = slurp(path("results/leaderboard.html"));
  for (const char* word : {" src=\"", " href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_EQ(leaderboard({"--pictures", "none"}).err, "");
}

/// The page, if there is a browser.
TEST_F(Leaderboard, ClassesAreOfSingleFrames) {
  Json document = measurements();
  document["scenes"] = {scene("hall", "frame"), scene("statue", "frame"), scene("hall-display", "display")};
  document["scenes"][1]["class"] = "object";
  document["results"] = {row("hbao+", "hall", "frame", 0.2, 1), row("hbao+", "statue", "frame", 0.1, 1),
                         row("lightfield-hbao+", "hall-display", "display", 0.02, 1)};
  write("a/bench.json", document);
  const Json made = Json::parse(leaderboard().out);
  EXPECT_EQ(row_of(made, "architecture", "hbao+")["error"], 0.2);
  EXPECT_TRUE(row_of(made, "architecture", "lightfield-hbao+").is_null());
  EXPECT_TRUE(row_of(made, "all", "hbao+")["error"].is_null()) << "not measured on the display";
}

class LeaderboardInBrowser : public Leaderboard {
 protected:
  void SetUp() override {
    if (!has_browser()) GTEST_SKIP() << "no chromium to look with (Debian: chromium)";
    Leaderboard::SetUp();
    fs::create_directories(path("results/a/images/hall"));
    for (const auto& [name, value] :
         {std::pair("truth", 200), std::pair("gtao", 210), std::pair("hbao+", 100), std::pair("other", 90)})
      write_png(path(std::string("results/a/images/hall/") + name + ".png"),
                cv::Mat(32, 48, CV_8UC2, cv::Scalar(value, 255)));
    write("a/bench.json", measurements());
  }

  Json look(const std::string& script, const Opening& opening = {}) const {
    const Result made = leaderboard({});
    EXPECT_EQ(made.status, 0) << made.err;
    const std::string begin =
        "const rows = () => [...document.querySelectorAll('#methods-table tbody tr')];"
        "const names = () => rows().map((row) => row.cells[0].textContent);"
        "const head = (name) => [...document.querySelectorAll('#methods-table th button')].find((b) => b.textContent "
        "=== name);"
        "const cell = (row, name) => rows()[row].cells[[...document.querySelectorAll('#methods-table "
        "th')].indexOf(head(name).parentElement)];"
        "const shown = () => document.getElementById('viewer').dataset.shown;"
        "await until(() => rows().length > 0 && shown());";
    return in_browser(path("results/leaderboard.html"), begin, script, opening);
  }
};

TEST_F(LeaderboardInBrowser, SortsByClickAndMarksTheBest) {
  const Json result = look(R"js(
    result.requests = performance.getEntriesByType('resource').map((entry) => entry.name);
    result.first = names();
    result.best = rows().map((row) => row.querySelectorAll('.best').length);
    result.partial = cell(3, 'error').textContent + ' ' + cell(3, 'items').textContent;
    result.time = cell(1, 'time / HBAO+').textContent;
    head('SSIM').click();
    result.ssim = [names(), head('SSIM').parentElement.getAttribute('aria-sort')];
    head('time / HBAO+').click();
    result.times = names();
    head('time / HBAO+').click();
    result.times_down = names();
    result.lead = document.getElementById('lead').textContent;
    result.markup = document.querySelectorAll('#methods-table b').length;
    result.links = [...document.querySelectorAll('#methods-table a')].map((a) => a.href);
    result.remark = document.getElementById('methods-remark').textContent;
  )js");
  EXPECT_EQ(result["requests"], Json::array());
  EXPECT_EQ(result["first"], Json({"gtao medium", "Engine <b>AO</b> 7submitted", "hbao+ medium", "ssao medium"}));
  EXPECT_EQ(result["best"], Json({4, 0, 1, 0})) << "error, SSIM, FLIP and flicker; time";
  EXPECT_EQ(result["partial"], "– 1 of 2");
  EXPECT_EQ(result["time"], "2.50 ms stated");
  EXPECT_EQ(result["ssim"][0][0], "gtao medium");
  EXPECT_EQ(result["ssim"][1], "descending") << "most is best";
  EXPECT_EQ(result["times"], Json({"hbao+ medium", "gtao medium", "ssao medium", "Engine <b>AO</b> 7submitted"}))
      << "rows without a ratio last";
  EXPECT_EQ(result["times_down"][0], "gtao medium");
  EXPECT_EQ(result["markup"], 0);
  EXPECT_EQ(result["links"], Json({"https://example.org/ao"}));
  const std::string lead = result["lead"], remark = result["remark"];
  EXPECT_EQ(std::count(lead.begin(), lead.end(), '.'), 3) << "three sentences: " << lead;
  EXPECT_NE(remark.find("1 row was not measured on all"), std::string::npos) << remark;
  EXPECT_NE(remark.find("1 row is hidden"), std::string::npos) << remark;
}

TEST_F(LeaderboardInBrowser, OpensWithTheAnswerAsWordsChartAndPictures) {
  const Json result = look(R"js(
    result.sections = [...document.querySelectorAll('main > section')].map((section) => section.id).slice(0, 3);
    result.words = document.getElementById('verdict').textContent;
    result.first = shown();
    const points = () => [...document.querySelectorAll('#scatter .point_marks path')];
    await until(() => points().length > 0);
    result.points = points().length;
    result.levels = document.querySelectorAll('#scatter .level_rules line').length;
    click(points()[[...document.getElementById('scatter').view.data('points')].findIndex((p) => p.label === 'hbao+ medium')]);
    await until(() => shown() === 'hbao+ medium');
  )js");
  EXPECT_EQ(result["sections"], Json({"costs", "method", "methods"}));
  EXPECT_EQ(
      result["words"],
      "Nearest to the truth on all 2 items is gtao medium: error 0.1200, at 1.60\u202f× the time of HBAO+ medium. Of "
      "what takes no longer than HBAO+ medium, hbao+ medium is nearest: error 0.2200.");
  EXPECT_EQ(result["first"], "gtao medium");
  EXPECT_EQ(result["points"], 2);
  EXPECT_EQ(result["levels"], 1) << "the submitted method has no time that compares";
}

TEST_F(LeaderboardInBrowser, ChoosesItemsVariantsAndTheFit) {
  const Json result = look(R"js(
    const choose = (text) => {
      const select = document.querySelector('#choices select');
      select.value = [...select.options].find((option) => option.textContent.startsWith(text)).value;
      select.dispatchEvent(new Event('change'));
    };
    choose('sequences');
    result.sequences = names();
    result.heading = document.querySelector('.choice-name').textContent;
    choose('single frames');
    document.getElementById('show-variants').click();
    result.frames = names();
    choose('all items');
    document.getElementById('show-fit').click();
    result.fit = [names()[0], cell(0, 'error').textContent];
  )js");
  EXPECT_EQ(result["sequences"][0], "ssao medium");
  EXPECT_EQ(result["sequences"].size(), 4u);
  EXPECT_EQ(result["heading"], "on walk");
  EXPECT_EQ(result["frames"], Json({"gtao medium", "gtao medium", "Engine <b>AO</b> 7submitted", "hbao+ medium"}));
  EXPECT_EQ(result["fit"][0], "Engine <b>AO</b> 7submitted");
  EXPECT_EQ(result["fit"][1], "fit 0.0600 (best)");
}

// Displays are computed by other techniques, so all items together have no mean of any technique.
TEST_F(LeaderboardInBrowser, OpensOnTheItemsThatMostMethodsHaveMeansOf) {
  Json document = measurements();
  document["scenes"].push_back(scene("stair", "frame"));
  document["scenes"].push_back(scene("statue", "display"));
  document["results"] = {row("hbao+", "hall", "frame", 0.2, 1), row("hbao+", "stair", "frame", 0.1, 1),
                         row("gtao", "hall", "frame", 0.1, 1), row("gtao", "stair", "frame", 0.1, 1),
                         row("lightfield-hbao+", "statue", "display", 0.02, 1)};
  write("a/bench.json", document);
  const Json result = look(R"js(
    result.heading = document.querySelector('.choice-name').textContent;
    result.first = [names(), cell(0, 'error').textContent];
    result.heads = [...document.querySelectorAll('#items-table th')].map((th) => th.textContent);
  )js");
  EXPECT_EQ(result["heading"], "on single frames, 2 items");
  EXPECT_EQ(result["first"][0], Json({"gtao medium", "hbao+ medium"}));
  EXPECT_NE(result["first"][1], "–");
  EXPECT_EQ(std::count(result["heads"].begin(), result["heads"].end(), "kind"), 0) << "all are frames";
}

TEST_F(LeaderboardInBrowser, ShowsTheMethodThatIsPickedByKeyOrClick) {
  const Json result = look(R"js(
    result.first = shown();
    const centre = () => [...document.querySelector('#viewer canvas').getContext('2d').getImageData(24, 16, 1, 1).data].slice(0, 3);
    result.brighter = centre();
    const row = rows()[2];
    row.focus();
    row.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}));
    await until(() => shown() === 'hbao+ medium' && document.querySelector('#viewer .image'));
    result.darker = centre();
    result.focus = document.activeElement.classList.contains('is-picked');
    const slider = document.querySelector('#viewer .slider');
    slider.value = 25;
    slider.dispatchEvent(new Event('input'));
    result.wipe = document.querySelector('.wipe').style.getPropertyValue('--at');
    result.items = document.querySelectorAll('#items-table tbody tr').length;
    result.commands = [...document.querySelectorAll('#commands code')].map((code) => code.textContent);
    document.querySelector('#commands .copy').click();
    await until(() => document.querySelector('#commands .copy').textContent !== 'Copy');
    click(rows()[1]);
    await until(() => shown().startsWith('Engine'));
    result.submitted = document.getElementById('facts-of-method').textContent;
    click(document.querySelectorAll('#items-table tbody tr')[1]);
    await until(() => document.getElementById('viewer').textContent.includes('no picture'));
    result.item = document.getElementById('method-name').textContent;
    result.files = document.getElementById('files-table').textContent;
  )js");
  EXPECT_EQ(result["first"], "gtao medium");
  EXPECT_GT(result["brighter"][0], result["brighter"][2]) << "orange";
  EXPECT_LT(result["darker"][0], result["darker"][2]) << "blue";
  EXPECT_EQ(result["focus"], true);
  EXPECT_EQ(result["wipe"], "25%");
  EXPECT_EQ(result["items"], 2);
  ASSERT_EQ(result["commands"].size(), 2u);
  EXPECT_EQ(result["commands"][0].get<std::string>().rfind("gloam run hbao+ test-1/frames/hall.exr", 0), 0u);
  const std::string submitted = result["submitted"], files = result["files"];
  for (const char* words : {"their device", "2.50 ms", "1 − 0.900 (1 − AO^1.50)", "0.0500"})
    EXPECT_NE(submitted.find(words), std::string::npos) << words << submitted;
  EXPECT_NE(result["item"].get<std::string>().find("on walk"), std::string::npos);
  for (const char* words : {"a/bench.json", "aaaaaaaaaaaa", "0123abc", "a device"})
    EXPECT_NE(files.find(words), std::string::npos) << words;
}

TEST_F(LeaderboardInBrowser, FitsANarrowScreen) {
  const Json result = look("result.wider = document.documentElement.scrollWidth - innerWidth;", {400, ""});
  EXPECT_LE(result["wider"], 0);
}

}  // namespace
}  // namespace gloam::test::leaderboard_test
