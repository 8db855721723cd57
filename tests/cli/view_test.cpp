// gloam view: what the page holds, and that it shows it in a browser that opens it from disk.
#include <Imath/half.h>
#include <pty.h>
#include <sys/inotify.h>

#include <bit>
#include <cmath>
#include <limits>

#include "cli/browser.h"

namespace gloam::test::view_test {
namespace {

using Json = nlohmann::json;

constexpr float inf = std::numeric_limits<float>::infinity(), not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Floats of all sizes and signs, other ones in each channel.
float any_float(uint32_t seed) {
  uint32_t h = seed * 2654435761u + 12345u;
  h ^= h >> 15;
  h *= 2246822519u;
  h ^= h >> 13;
  return std::bit_cast<float>(h);
}

/// As `hash` of the page.
uint32_t hash_of(const Channel& channel) {
  uint32_t h = 2166136261u;
  for (int y = 0; y < channel.layout().height; ++y)
    for (int x = 0; x < channel.layout().width; ++x) h = (h ^ std::bit_cast<uint32_t>(channel.at(x, y))) * 16777619u;
  return h;
}

void fill(Plane& plane, uint32_t seed) {
  for (Channel& channel : plane.channels)
    for (int y = 0; y < channel.layout().height; ++y)
      for (int x = 0; x < channel.layout().width; ++x) channel.at(x, y) = any_float(seed++);
}

void fill(Frame& frame, const std::string& plane, float value) {
  for (View& view : frame.views)
    for (Channel& channel : view.planes.at(plane).channels)
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = value;
}

/// What scripts of these tests call.
const std::string begin =
    "await until(() => shown.reference); await showing; drawStage();"
    "const hash = (floats) => { let h = 2166136261; for (const b of new Uint32Array(floats.buffer, floats.byteOffset, "
    "floats.length)) h = Math.imul(h ^ b, 16777619) >>> 0; return h; };"
    "const onScreen = (x, y, pane = panes()[0]) => { const [u, v] = placeIn(pane, x + 0.5, y + 0.5);"
    " return [...pen.getImageData(Math.floor(u * deviceScale()), Math.floor(v * deviceScale()), 1, 1).data.slice(0, "
    "3)]; };"
    "const point = (x, y, type = 'pointermove', more = {}) => { const [u, v] = placeIn(panes()[0], x + 0.5, y + 0.5), "
    "box = stage.getBoundingClientRect();"
    " stage.dispatchEvent(new PointerEvent(type, {clientX: box.left + u, clientY: box.top + v, bubbles: true, "
    "...more})); };"
    "const cells = () => [...document.querySelectorAll('#values tr:not(.head)')].map((row) => "
    "[...row.children].map((cell) => cell.textContent));"
    "const press = (key, more = {}) => document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, "
    "...more}));"
    "const choose = (label, value) => { const box = document.querySelector(`[aria-label=\"${label}\"]`); box.value = "
    "value; "
    "box.dispatchEvent(new Event('change')); return showing; };";

class ViewPage : public BrowserTest {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }

  Result view(Arguments arguments, const Arguments& more = {}) const {
    arguments.insert(arguments.begin(), "view");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }

  /// A frame of one view with a constant result.
  void write_result(const std::string& name, float ao, int width = 32, int height = 24) const {
    Frame frame = small_frame(width, height, {"depth", "ao"});
    fill(frame, "ao", ao);
    write_frame(path(name), frame);
  }

  void expect_refused(const Arguments& arguments, int status, const std::string& says) const {
    const std::vector<std::string> before = files();
    const Result result = view(arguments);
    EXPECT_EQ(result.status, status) << says << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << "a refused command leaves nothing behind";
  }
};

class ViewInBrowser : public ViewPage {
 protected:
  void SetUp() override {
    if (!has_browser()) GTEST_SKIP() << "no chromium to look with (Debian: chromium)";
    ViewPage::SetUp();
  }

  /// Writes page.html of files, and runs a script in it.
  Json page_of(const Arguments& names, const std::string& script, const Opening& opening = {},
               const Arguments& more = {}) const {
    Arguments arguments;
    for (const std::string& name : names) arguments.push_back(file(name));
    arguments.insert(arguments.end(), {"-o", file("page.html")});
    const Result result = view(arguments, more);
    EXPECT_EQ(result.status, 0) << result.err;
    return in_browser(path("page.html"), begin, script, opening);
  }
};

// --- The command

TEST_F(ViewPage, WritesOneFileBesideTheFirst) {
  write_frame(path("frame.exr"), small_frame());
  write_result("ao.exr", 0.5f);
  const Result result = view({file("frame.exr"), file("ao.exr")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out.rfind("wrote " + file("frame.view.html") + ": 2 files, 2 frames, ", 0), 0u) << result.out;
  EXPECT_NE(result.out.find("open it in a browser"), std::string::npos) << result.out;
  EXPECT_EQ(files(), (Arguments{"ao.exr", "frame.exr", "frame.view.html"}));
  const std::string page = slurp(path("frame.view.html"));
  for (const char* word : {" src=\"", " href=\"http", "@import", "url(http", "@@", GLOAM_SOURCE_DIR})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_EQ(page.find(folder.string()), std::string::npos)
      << "a page that is passed on names no folder of this machine";
  EXPECT_EQ(view({file("frame.exr")}).status, 0) << "its own page is written anew";
}

TEST_F(ViewPage, SaysWhatItWroteAsJson) {
  for (const int frame : {1, 2}) write_frame(path(fmt::format("shot.{:04}.exr", frame)), small_frame());
  write_result("ao.exr", 0.5f);
  const Result result = view({file("shot.####.exr"), file("ao.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  EXPECT_EQ(document["page"], file("shot.view.html"));
  EXPECT_EQ(document["bytes"], fs::file_size(path("shot.view.html")));
  EXPECT_EQ(document["opened"], false);
  EXPECT_EQ(document["files"][0],
            Json({{"name", "shot.####.exr"}, {"frames", {1, 2}}, {"planes", {"depth", "color"}}}));
  EXPECT_EQ(document["files"][1], Json({{"name", "ao.exr"}, {"frames", Json::array()}, {"planes", {"depth", "ao"}}}));
  EXPECT_EQ(document["notes"], Json::array());
}

/// Counts how often a file is opened while it lives.
class Openings {
 public:
  explicit Openings(const fs::path& file) : queue_(inotify_init1(IN_NONBLOCK)) {
    inotify_add_watch(queue_, file.c_str(), IN_OPEN | IN_CLOSE);  // equal events in a row would be one
  }
  ~Openings() { close(queue_); }
  Openings(const Openings&) = delete;
  Openings& operator=(const Openings&) = delete;
  int count() {
    inotify_event event;  // without a name, as the file itself is watched
    while (read(queue_, &event, sizeof event) == sizeof event) count_ += (event.mask & IN_OPEN) != 0;
    return count_;
  }

 private:
  int queue_, count_ = 0;
};

/// Headers may be far away and many: each is looked at once, and opened once more where the planes are read.
TEST_F(ViewPage, OpensEachFileTwice) {
  for (const int frame : {1, 2}) write_frame(path(fmt::format("shot.{:04}.exr", frame)), small_frame());
  Openings once(path("shot.0002.exr"));
  FrameFile(path("shot.0002.exr"), {});
  const int each = once.count();
  ASSERT_GT(each, 0) << "no inotify here";
  Openings viewed(path("shot.0002.exr"));
  ASSERT_EQ(view({file("shot.####.exr")}).status, 0);
  EXPECT_LE(viewed.count(), 2 * each);
}

TEST_F(ViewPage, TellsFilesOfOneNameApartByTheirFolders) {
  for (const char* each : {"low", "high"}) {
    fs::create_directory(path(each));
    write_result(std::string(each) + "/ao.exr", 0.5f);
  }
  const Result result = view({file("low/ao.exr"), file("high/ao.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["files"][0]["name"], "low/ao.exr");
  EXPECT_EQ(result.json()["files"][1]["name"], "high/ao.exr");
}

TEST_F(ViewPage, NotesWhatCannotBeCompared) {
  write_frame(path("frame.exr"), small_frame(32, 24, {"color"}));
  Frame result = small_frame(32, 24, {"ao"});
  write_frame(path("ao.exr"), result);
  const Result said = view({file("frame.exr"), file("ao.exr")});
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("note: frame.exr and ao.exr have no plane in common: color beside ao"), std::string::npos)
      << said.err;
}

TEST_F(ViewPage, SaysWhatIsWrongAndWritesNothing) {
  write_frame(path("frame.exr"), small_frame());
  write_result("ao.exr", 0.5f);
  write_frame(path("shot.0001.exr"), small_frame());
  std::ofstream(path("text.exr")) << "no EXR";
  std::ofstream(path("frame.view.html")) << "<p>written by hand</p>";
  fs::create_directory(path("folder"));
  const std::string frame = file("frame.exr"), page = file("page.html");
  expect_refused({file("nowhere.exr"), "-o", page}, 1, "nowhere.exr");
  expect_refused({file("text.exr"), "-o", page}, 1, "text.exr");
  expect_refused({frame, "-o", page, "--planes", "dept"}, 2,
                 "--planes dept: no file has such a plane (did you mean 'depth'?)");
  expect_refused({frame, file("ao.exr"), "-o", page, "--planes", "ao"}, 1,
                 "frame.exr: has none of --planes ao; it has");
  expect_refused({frame, "-o", frame}, 2, "is also a file to show");
  expect_refused({frame, file("ao.exr"), "-o", file("ao.exr")}, 2, "is also a file to show");
  expect_refused({file("shot.####.exr"), "-o", file("shot.0001.exr")}, 2, "is also what frame 1 is read from");
  expect_refused({frame, "-o", page, "--json", page}, 2, "--json");
  expect_refused({frame, "-o", file("nowhere/page.html")}, 1, "is not a folder");
  expect_refused({frame, "-o", file("folder")}, 1, "folder");
  expect_refused({frame}, 1, "frame.view.html: is there, and gloam view has not made it; -o names another page");
  expect_refused({frame, "-o", page, "--frames", "1-2"}, 2, "--frames: is for a shot");
  expect_refused({file("shot.####.exr"), "-o", page, "--frames", "1-3"}, 1, "frames 2-3 are missing");
  expect_refused({file("none.####.exr"), "-o", page}, 1, "no file of this pattern is there");
  expect_refused({frame, "-o", page, "--view", "left"}, 1, "left");
  expect_refused({frame, "-o", page, "--as-read", "--as-stored"}, 2, "--as-stored");
  expect_refused({frame, "-o", page, "--limit-memory", "1M"}, 1, "--limit-memory 1M allows");
  EXPECT_EQ(slurp(path("frame.view.html")), "<p>written by hand</p>");
}

TEST_F(ViewPage, LeavesFramesOutThatAreMissing) {
  for (const int frame : {1, 3}) write_frame(path(fmt::format("shot.{:04}.exr", frame)), small_frame());
  const Result result = view({file("shot.####.exr"), "--frames", "1-3", "--missing", "skip", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["files"][0]["frames"], Json({1, 3}));
  EXPECT_NE(result.err.find("2 missing: left out"), std::string::npos) << result.err;
}

TEST_F(ViewPage, IsSmallerWithHalfScaleAndFewerPlanes) {
  Frame frame = small_frame(256, 128);
  fill(frame.views[0].planes.at("color"), 3);
  write_frame(path("frame.exr"), frame);
  const auto size = [&](const Arguments& more) {
    EXPECT_EQ(view({file("frame.exr"), "-o", file("page.html")}, more).status, 0);
    return fs::file_size(path("page.html"));
  };
  const auto all = size({});
  EXPECT_LT(size({"--planes", "depth"}) + 300'000, all);
  EXPECT_LT(size({"--scale", "2"}) + 300'000, all);
}

TEST_F(ViewPage, KeepsFloatWhereHalfWouldBeInfinite) {
  Frame frame = small_frame();
  fill(frame, "color", 70000.0f);
  write_frame(path("frame.exr"), frame);
  const Result result = view({file("frame.exr"), "--half"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("--half: color of frame.exr has values beyond the range of half, and stays float"),
            std::string::npos)
      << result.err;
}

// --- Opening it

/// Runs gloam on a terminal of its own, with an xdg-open that writes down what it is given; returns that.
class ViewOnTerminal : public ViewPage {
 protected:
  void SetUp() override {
    ViewPage::SetUp();
    write_frame(path("frame.exr"), small_frame());
    fs::create_directory(path("bin"));
    std::ofstream(path("bin/xdg-open")) << "#!/bin/sh\necho \"$1\" >'" << file("opened") << "'\n";
    fs::permissions(path("bin/xdg-open"), fs::perms::all);
  }

  std::string opened(const Arguments& more, const char* display) const {
    fs::remove(path("opened"));
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      setenv("PATH", (file("bin") + ":" + getenv("PATH")).c_str(), 1);
      unsetenv("WAYLAND_DISPLAY");
      display ? setenv("DISPLAY", display, 1) : unsetenv("DISPLAY");
      const std::string frame = file("frame.exr");
      std::vector<const char*> words = {program, "view", frame.c_str()};
      for (const std::string& word : more) words.push_back(word.c_str());
      words.push_back(nullptr);
      execv(program, const_cast<char* const*>(words.data()));
      _exit(127);
    }
    char said[4096];
    while (read(terminal, said, sizeof said) > 0) {
    }
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    EXPECT_EQ(status, 0);
    // The program that opens it lives on by itself.
    const bool is_to_open = display && more.empty();
    for (int i = 0; i < (is_to_open ? 8000 : 40) && slurp(path("opened")).empty(); ++i)
      usleep(is_to_open ? 50'000 : 5'000);
    return slurp(path("opened"));
  }
};

TEST_F(ViewOnTerminal, IsOpenedWhereThereIsADisplay) {
  EXPECT_EQ(opened({}, ":0"), file("frame.view.html") + "\n");
  EXPECT_EQ(opened({"--no-open"}, ":0"), "");
  EXPECT_EQ(opened({}, nullptr), "");
  EXPECT_EQ(opened({"--json", "-"}, ":0"), "");
  fs::remove(path("opened"));
  EXPECT_EQ(gloam({"view", file("frame.exr")}, {{"DISPLAY", ":0"}, {"PATH", file("bin") + ":/usr/bin:/bin"}}).status,
            0);
  usleep(200'000);
  EXPECT_FALSE(fs::exists(path("opened"))) << "standard output is no terminal";
}

// --- Values

TEST_F(ViewInBrowser, HasEveryBitOfEveryPlaneViewAndFrame) {
  uint32_t seed = 1;
  Json expected = Json::array();
  for (const int number : {7, 8}) {
    Frame frame = small_frame(37, 23, {"depth", "color", "ao", "motion", "roughness"});
    frame.views[0].planes.at("motion").channels.emplace_back(Layout(37, 23), 0.0f);
    frame.views.push_back(View{"right", frame.views[0].camera, {}, {}, {}});
    frame.views[0].name = "left";
    for (const auto& [name, plane] : frame.views[0].planes) frame.views[1].planes[name] = plane.clone();
    for (View& view : frame.views)
      for (auto& [name, plane] : view.planes) {
        if (name != "depth") fill(plane, seed += 10'000);
        for (size_t c = 0; c < plane.channels.size(); ++c)
          expected.push_back({number, view.name, name, c, hash_of(plane.channels[c])});
      }
    write_frame(path(fmt::format("shot.{:04}.exr", number)), frame);
  }
  const Json result = page_of({"shot.####.exr"}, R"js(
    result.hashes = [];
    for (const frame of data.files[0].frames) {
      await toFrame(frame.number);
      for (const view of frame.views)
        for (const plane of [...view.planes].sort((a, b) => (a.name < b.name ? -1 : 1))) {
          const image = await imageOf({file: 0, view: view.name, plane: plane.name});
          image.channels.forEach((channel, c) => result.hashes.push([frame.number, view.name, plane.name, c, hash(channel)]));
        }
    }
  )js");
  EXPECT_EQ(result["hashes"], expected);
}

TEST_F(ViewInBrowser, TellsTheFloatUnderTheCursor) {
  Frame frame = small_frame(8, 6, {"depth", "color"});
  const float values[] = {0.1f, 1.0f / 3, 16777216.0f, 1e-7f, 123456.789f, -0.0f, std::nextafter(1.0f, 2.0f), 3.4e38f};
  for (int x = 0; x < 8; ++x) frame.views[0].planes.at("color").channels[1].at(x, 2) = values[x];
  frame.views[0].planes.at("depth").channels[0].at(3, 3) = inf;
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    result.texts = [];
    for (let x = 0; x < 8; ++x) {
      point(x, 2);
      result.texts.push(cells()[1][1]);
    }
    result.caption = document.querySelector('#values caption').textContent;
    point(2, 2, 'pointerleave');
    result.gone = document.querySelector('#values').textContent;
    await choose('Plane of A', 'depth');
    point(3, 3);
    result.depth = cells()[0][1];
  )js");
  EXPECT_EQ(result["texts"].size(), 8u);
  for (size_t x = 0; x < 8; ++x) {
    std::string text = result["texts"][x];
    if (text.rfind("\u2212", 0) == 0) text = "-" + text.substr(3);
    if (const size_t sign = text.find("\u2212"); sign != std::string::npos) text.replace(sign, 3, "-");
    EXPECT_EQ(std::bit_cast<uint32_t>(std::stof(text)), std::bit_cast<uint32_t>(values[x])) << text;
    EXPECT_LE(text.size(), 12u) << "as short as it can be";
  }
  EXPECT_EQ(result["texts"][0], "0.1");
  EXPECT_EQ(result["caption"], "Pixel 7, 2");
  EXPECT_NE(result["gone"].get<std::string>().find("Point at a pixel"), std::string::npos);
  EXPECT_EQ(result["depth"], "+inf");
}

TEST_F(ViewInBrowser, RoundsToHalfAndKeepsEveryNthPixelWhereAsked) {
  Frame frame = small_frame(9, 7, {"depth", "color"});
  std::vector<float> expected;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      float& value = frame.views[0].planes.at("color").channels[0].at(x, y);
      value = std::ldexp(0.731f, x - 22) * float(y % 2 ? -1 : 1) * float(y + 1);  // denormal halves too
      if (x % 2 == 0 && y % 2 == 0) expected.push_back(float(Imath::half(value)));
    }
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    const image = await imageOf({file: 0, view: '', plane: 'color'});
    result.size = [image.width, image.height];
    result.values = [...image.channels[0]];
    changeMode('a');
    await choose('Plane of A', 'color');
    point(4.5, 2.5);
    result.caption = document.querySelector('#values caption').textContent;
    result.about = byId('about').textContent;
  )js",
                              {}, {"--half", "--scale", "2"});
  EXPECT_EQ(result["size"], Json({5, 4}));
  EXPECT_EQ(result["values"], Json(expected));
  EXPECT_EQ(result["caption"], "Pixel 4, 2") << "in pixels of the file";
  EXPECT_NE(result["about"].get<std::string>().find("rounded to half"), std::string::npos);
}

TEST_F(ViewInBrowser, ShowsDepthAsGloamReadsItOrAsStored) {
  Frame frame = small_frame(8, 6, {"depth", "ao"});
  fill(frame, "ao", 1.5f);
  Channel& depth = frame.views[0].planes.at("depth").channels[0];
  depth.at(0, 0) = 1e10f;
  write_frame(path("frame.exr"), frame);
  const std::string script = R"js(
    const [depth, ao] = [await imageOf({file: 0, view: '', plane: 'depth'}), await imageOf({file: 0, view: '', plane: 'ao'})];
    result.values = [String(depth.channels[0][0]), depth.background[0], ao.channels[0][3]];
    result.about = byId('about').textContent;
  )js";
  Json result = page_of({"frame.exr"}, script);
  EXPECT_EQ(result["values"], Json({"Infinity", 1, 1.5}));
  EXPECT_NE(result["about"].get<std::string>().find("all other values are as the file has them"), std::string::npos);
  result = page_of({"frame.exr"}, script, {}, {"--as-stored"});
  EXPECT_EQ(result["values"], Json({"10000000000", 0, 1.5}));
  EXPECT_NE(result["about"].get<std::string>().find("nothing is converted"), std::string::npos);
  result = page_of({"frame.exr"}, script, {}, {"--as-read"});
  EXPECT_EQ(result["values"], Json({"Infinity", 1, 1})) << "shares are clamped";
}

// --- Colours

/// The byte of linear light on the page.
int srgb_byte(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return int(std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

TEST_F(ViewInBrowser, ExposureAndRangeChangePixelsAsComputed) {
  Frame frame = small_frame(8, 6, {"depth", "color", "ao"});
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 8; ++x)
        frame.views[0].planes.at("color").channels[size_t(c)].at(x, y) = 0.03f * float(1 + x + c);
  fill(frame, "ao", 0.4f);
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    await choose('Plane of A', 'color');
    result.plain = onScreen(3, 2);
    const slider = document.querySelector('[aria-label="Exposure in stops"]');
    slider.value = 1.5;
    slider.dispatchEvent(new Event('input'));
    drawStage();
    result.brighter = onScreen(3, 2);
    press('E');
    drawStage();
    result.by_key = onScreen(3, 2);
    await choose('Plane of A', 'ao');
    drawStage();
    result.ao = onScreen(1, 1);
    await choose('Value at the dark end', '0.2');
    await choose('Value at the bright end', '0.6');
    drawStage();
    result.in_range = onScreen(1, 1);
    await choose('Colour map', 'viridis');
    drawStage();
    result.viridis = onScreen(1, 1);
    await choose('Curve', 'gamma 2.2');
    await choose('Colour map', 'grey');
    drawStage();
    result.gamma = onScreen(1, 1);
  )js");
  for (size_t c = 0; c < 3; ++c) {
    const double value = 0.03 * double(1 + 3 + c);
    EXPECT_NEAR(result["plain"][c].get<int>(), srgb_byte(value), 1);
    EXPECT_NEAR(result["brighter"][c].get<int>(), srgb_byte(value * std::exp2(1.5)), 1);
    EXPECT_NEAR(result["by_key"][c].get<int>(), srgb_byte(value * 4), 1);
    EXPECT_NEAR(result["ao"][c].get<int>(), 102, 1);
    EXPECT_NEAR(result["in_range"][c].get<int>(), 128, 1);
    EXPECT_NEAR(result["gamma"][c].get<int>(), int(std::lround(255 * std::pow(0.5, 1 / 2.2))), 1);
  }
  const int viridis[] = {33, 144, 141};  // the middle of the map
  for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(result["viridis"][c].get<int>(), viridis[c], 3);
}

TEST_F(ViewInBrowser, MarksAndCountsWhatIsOnNoScale) {
  Frame frame = small_frame(8, 6, {"depth", "ao"});
  Channel& ao = frame.views[0].planes.at("ao").channels[0];
  ao.at(1, 1) = not_a_number;
  ao.at(2, 1) = inf;
  ao.at(3, 1) = -inf;
  ao.at(4, 1) = ao.at(5, 1) = -0.25f;
  frame.views[0].planes.at("depth").channels[0].at(6, 1) = inf;
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    await choose('Plane of A', 'ao');
    drawStage();
    result.marked = [1, 2, 3, 4].map((x) => onScreen(x, 1));
    result.background = paintedOf(shown.a).getContext('2d').getImageData(6, 1, 1, 1).data[3];
    result.counts = byId('counts').textContent;
    byId('marks').click();
    drawStage();
    result.plain = [1, 2, 3, 4].map((x) => onScreen(x, 1));
    await choose('Plane of A', 'depth');
    result.of_depth = byId('counts').textContent;
  )js");
  EXPECT_EQ(result["marked"], Json({{255, 0, 255}, {0, 208, 255}, {0, 208, 255}, {64, 96, 255}}));
  EXPECT_EQ(result["plain"], Json({{0, 0, 0}, {255, 255, 255}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(result["background"], 0) << "the hatching shows through";
  const std::string counts = result["counts"];
  for (const char* words : {"background1 pixel", "NaN1 value", "\u2212infinite1 value", "negative2 values"})
    EXPECT_NE(counts.find(words), std::string::npos) << words << "\n" << counts;
  EXPECT_NE(result["of_depth"].get<std::string>().find("background1 pixel"), std::string::npos);
  EXPECT_EQ(result["of_depth"].get<std::string>().find("infinite"), std::string::npos) << result["of_depth"];
}

TEST_F(ViewInBrowser, ChoosesOneComponentOrTheLength) {
  Frame frame = small_frame(8, 6, {"depth", "color"});
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 8; ++x)
        frame.views[0].planes.at("color").channels[size_t(c)].at(x, y) = c == 0 ? 0.6f : c == 1 ? 0.8f : 0.0f;
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    await choose('Plane of A', 'color');
    result.choices = [...document.querySelector('[aria-label="Component"]').options].map((option) => option.value);
    await choose('Curve', 'linear');
    result.values = [];
    for (const channel of ['0', '1', 'length', 'luminance']) {
      await choose('Component', channel);
      await choose('Value at the dark end', '0');
      await choose('Value at the bright end', '2');
      drawStage();
      result.values.push(onScreen(2, 2)[0]);
    }
  )js");
  EXPECT_EQ(result["choices"], Json({"all", "0", "1", "2", "length", "luminance"}));
  const double expected[] = {0.3, 0.4, 0.5, (0.2126 * 0.6 + 0.7152 * 0.8) / 2};
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(result["values"][i].get<int>(), 255 * expected[i], 1.1) << i;
}

// --- Two files

/// Of a frame, a result and the truth the latter two are compared, whatever else they hold.
TEST_F(ViewInBrowser, OpensOnTheResultAgainstTheTruth) {
  write_frame(path("frame.exr"), small_frame());
  write_frame(path("result.exr"), small_frame(32, 24, {"ao"}));
  write_result("truth.exr", 0.75f);
  const std::string script = R"js(
    result.a = [state.a.file, state.a.plane];
    result.b = [state.b.file, state.b.plane];
    result.mode = state.mode;
  )js";
  write_result("other.exr", 0.25f);
  for (const char* test : {"result.exr", "other.exr"}) {
    const Json result = page_of({"frame.exr", test, "truth.exr"}, script);
    EXPECT_EQ(result["a"], Json({1, "ao"})) << test;
    EXPECT_EQ(result["b"], Json({2, "ao"})) << test;
    EXPECT_EQ(result["mode"], "wipe") << test;
  }
  EXPECT_EQ(page_of({"frame.exr", "result.exr"}, script)["a"][0], 0);
}

TEST_F(ViewInBrowser, WipesFlickersAndShowsSideBySide) {
  write_result("a.exr", 0.25f);
  write_result("b.exr", 0.75f);
  const Json result = page_of({"a.exr", "b.exr"}, R"js(
    result.mode = state.mode;
    const greys = () => [4, 14, 17, 28].map((x) => onScreen(x, 12)[0]);
    const slideTo = (share) => {
      const box = stage.getBoundingClientRect();
      byId('divider').dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + share * box.width, clientY: box.top + 50, buttons: 1, bubbles: true}));
      drawStage();
    };
    result.plane = [state.a.plane, state.b.plane];
    result.middle = greys();
    slideTo(0.999);
    result.a_alone = greys();
    slideTo(0.001);
    result.b_alone = greys();
    byId('divider').dispatchEvent(new KeyboardEvent('keydown', {key: 'End', bubbles: true}));
    drawStage();
    result.at_end = [byId('divider').getAttribute('aria-valuenow'), ...greys()];
    press('f');
    await showing;
    const seen = () => (drawStage(), onScreen(16, 12)[0]);
    result.flicker = [seen()];
    for (const key of ['f', 'f', 'b', 'b', 'a']) {
      press(key);
      result.flicker.push(seen());
    }
    state.rate = 3;
    press(' ');
    const first = state.phase;
    await until(() => state.phase !== first);
    await until(() => state.phase === first);
    press(' ');
    result.stops = state.flickers;
    press('s');
    await showing;
    result.beside = panes().map((pane) => onScreen(16, 12, pane)[0]);
    press('x');
    await showing;
    result.swapped = panes().map((pane) => onScreen(16, 12, pane)[0]);
    result.names = [byId('name-a').textContent, byId('name-b').textContent];
  )js");
  EXPECT_EQ(result["mode"], "wipe") << "two files with a plane in common";
  EXPECT_EQ(result["plane"], Json({"ao", "ao"})) << "a result before the depth";
  EXPECT_EQ(result["middle"], Json({64, 64, 191, 191}));
  EXPECT_EQ(result["a_alone"], Json({64, 64, 64, 64}));
  EXPECT_EQ(result["b_alone"], Json({191, 191, 191, 191}));
  EXPECT_EQ(result["at_end"], Json({"100", 64, 64, 64, 64}));
  EXPECT_EQ(result["flicker"], Json({64, 191, 64, 191, 191, 64}));
  EXPECT_EQ(result["stops"], false);
  EXPECT_EQ(result["beside"], Json({64, 191}));
  EXPECT_EQ(result["swapped"], Json({191, 64}));
  EXPECT_EQ(result["names"], Json({"A \u00b7 b.exr \u00b7 ao", "B \u00b7 a.exr \u00b7 ao"}));
}

TEST_F(ViewInBrowser, SubtractsFloatsAndAgreesWithCompare) {
  Frame a = small_frame(32, 24, {"depth", "ao"}), b = small_frame(32, 24, {"depth", "ao"});
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) {
      a.views[0].planes.at("ao").channels[0].at(x, y) = 0.01f * float((x * 7 + y * 13) % 100);
      b.views[0].planes.at("ao").channels[0].at(x, y) = 0.01f * float((x * 3 + y * 5) % 100);
    }
  for (Frame* frame : {&a, &b}) frame->views[0].planes.at("depth").channels[0].at(0, 0) = inf;
  write_frame(path("a.exr"), a);
  write_frame(path("b.exr"), b);
  const Json result = page_of({"a.exr", "b.exr"}, R"js(
    await changeMode('difference'), await showing;
    result.values = [[3, 4], [31, 23]].map(([x, y]) => shown.difference.channels[0][y * 32 + x]);
    result.background = shown.difference.background[0];
    result.figures = figuresOf(shown.difference);
    result.words = byId('figures').textContent;
    point(3, 4);
    result.cells = cells()[0];
    const [low, high] = [toneNow(shown.difference).low, toneNow(shown.difference).high];
    result.range = [low, high];
    drawStage();
    result.colours = [onScreen(3, 4), onScreen(31, 23)];
    result.expected = result.values.map((value) => mapColour('differences', (value - low) / (high - low)));
    changeMode('absolute');
    await showing;
    result.sizes = [[3, 4], [31, 23]].map(([x, y]) => shown.difference.channels[0][y * 32 + x]);
  )js");
  const auto difference = [&](int x, int y) {
    return a.views[0].planes.at("ao").channels[0].at(x, y) - b.views[0].planes.at("ao").channels[0].at(x, y);
  };
  EXPECT_EQ(result["values"], Json({difference(3, 4), difference(31, 23)}));
  EXPECT_EQ(result["sizes"], Json({std::abs(difference(3, 4)), std::abs(difference(31, 23))}));
  EXPECT_EQ(result["background"], 1);
  const Json compared = gloam({"compare", file("a.exr"), file("b.exr"), "--json", "-"}).json();
  EXPECT_NEAR(result["figures"]["rmse"], compared["rmse"], 1e-6);
  EXPECT_NEAR(result["figures"]["mean"], compared["bias"], 1e-6);
  EXPECT_NEAR(result["figures"]["largest"], compared["max"], 1e-6);
  EXPECT_EQ(result["figures"]["pixels"], compared["pixels"]);
  EXPECT_EQ(result["range"], Json({-1, 1}));
  for (size_t i = 0; i < 2; ++i)
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(result["colours"][i][c].get<int>(), result["expected"][i][c].get<int>(), 1);
  EXPECT_EQ(result["cells"].size(), 4u) << "the component, A, B and A - B";
}

TEST_F(ViewInBrowser, ChoosesPlanesViewsAndFilesOfEachSide) {
  Frame pair = small_frame(16, 12, {"depth", "color", "ao"});
  pair.views.push_back(View{"right", pair.views[0].camera, {}, {}, {}});
  pair.views[0].name = "left";
  for (const auto& [name, plane] : pair.views[0].planes) pair.views[1].planes[name] = plane.clone();
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) pair.views[1].planes.at("ao").channels[0].at(x, y) = 1;
  write_frame(path("pair.exr"), pair);
  const Json result = page_of({"pair.exr"}, R"js(
    result.first = [state.mode, state.a.view, state.b.view];
    await choose('Plane of A', 'ao');
    changeMode('beside');
    await choose('Plane of B', 'ao');
    point(4, 4);
    result.cells = cells()[0];
    press('v');
    await showing;
    point(4, 4);
    result.after_key = cells()[0];
    press('P', {shiftKey: true});
    await showing;
    result.plane = state.a.plane;
    result.named = [...document.querySelectorAll('select, input, #stage, #divider')].filter((each) => !each.getAttribute('aria-label') && !each.closest('label')).length;
  )js");
  EXPECT_EQ(result["first"], Json({"a", "left", "right"}));
  EXPECT_EQ(result["cells"], Json({"ao", "0.5", "1", "\u22120.5"}));
  EXPECT_EQ(result["after_key"], Json({"ao", "1", "1", "0"}));
  EXPECT_NE(result["plane"], "ao");
  EXPECT_EQ(result["named"], 0) << "controls without a name for a screen reader";
}

TEST_F(ViewInBrowser, AlignsFilesOfDifferentSizesByTheirDisplayWindows) {
  Frame part = small_frame(32, 24, {"ao"});
  part.window = {8, 6, 40, 30};
  part.display = {0, 0, 48, 36};
  fill(part, "ao", 0.25f);
  part.views[0].planes.at("ao").channels[0].at(0, 0) = 0.5f;
  write_frame(path("part.exr"), part);
  write_result("whole.exr", 0.75f, 48, 36);
  write_result("small.exr", 0.75f, 24, 18);
  Json result = page_of({"whole.exr", "part.exr"}, R"js(
    changeMode('difference');
    await choose('Plane of A', 'ao'), await choose('Plane of B', 'ao');
    result.at = [[8, 6], [9, 6], [7, 6], [39, 29], [40, 29]].map(([x, y]) => (shown.difference.background[y * 48 + x] ? null : shown.difference.channels[0][y * 48 + x]));
    point(8, 6);
    result.caption = document.querySelector('#values caption').textContent;
  )js");
  EXPECT_EQ(result["at"], Json({0.25, 0.5, nullptr, 0.5, nullptr}));
  EXPECT_EQ(result["caption"], "Pixel 8, 6");
  result = page_of({"whole.exr", "small.exr"}, R"js(
    changeMode('difference');
    await showing;
    result.message = byId('message').textContent;
    changeMode('b');
    changeMode('wipe');
    await showing;
    point(47, 35);
    result.cells = cells()[0];
    result.about = byId('about').textContent;
  )js");
  EXPECT_EQ(result["message"],
            "No difference: A has 48 \u00d7 36 pixels and B 24 \u00d7 18: there is no difference of pixels.");
  EXPECT_EQ(result["cells"], Json({"ao", "0.75", "0.75"}));
  EXPECT_NE(result["about"].get<std::string>().find("B (24 \u00d7 18) is drawn as wide as A (48 \u00d7 36)"),
            std::string::npos);
}

TEST_F(ViewInBrowser, GivesBTheRangeOfA) {
  Frame a = small_frame(), b = small_frame();
  Channel& deep = b.views[0].planes.at("depth").channels[0];
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) deep.at(x, y) *= 3;
  write_frame(path("a.exr"), a);
  write_frame(path("b.exr"), b);
  const Json result = page_of({"a.exr", "b.exr"}, R"js(
    const range = (side) => [toneNow(shown[side]).low, toneNow(shown[side]).high];
    await choose('Plane of A', 'depth');
    result.both = [range('a'), range('b')];
    changeMode('b');
    await showing;
    result.alone = range('b');
    press('r');
    result.own = range('b');
  )js");
  EXPECT_EQ(result["both"][0], result["both"][1]);
  EXPECT_GT(result["both"][0][0], result["both"][0][1]) << "near is bright";
  EXPECT_EQ(result["alone"], result["both"][0]) << "and where B is alone, too";
  EXPECT_NEAR(result["own"][0].get<double>(), 3 * result["both"][0][0].get<double>(), 1e-4);
}

TEST_F(ViewInBrowser, GoesThroughTheFramesOfAShot) {
  for (const int number : {3, 4, 6}) write_result(fmt::format("ao.{:04}.exr", number), 0.1f * float(number));
  write_result("truth.0004.exr", 0.9f);
  const Json result = page_of({"ao.####.exr", "truth.####.exr"}, R"js(
    const value = (side) => shown[side] && short(shown[side].channels[0][0]);
    result.first = [state.frame, value('a'), value('b')];
    result.missing = byId('message').textContent;
    press('.');
    await showing;
    result.second = [state.frame, value('a'), value('b')];
    const slider = byId('frame');
    slider.value = 2;
    slider.dispatchEvent(new Event('input'));
    await showing;
    result.last = [state.frame, value('a')];
    press('.');
    await showing;
    result.round = state.frame;
    press(' ');
    await until(() => state.frame === 6);
    press(' ');
    result.plays = plays;
  )js");
  EXPECT_EQ(result["first"], Json({3, 0.3, nullptr}));
  EXPECT_EQ(result["missing"], "truth.####.exr has no ao in frame 3.");
  EXPECT_EQ(result["second"], Json({4, 0.4, 0.9}));
  EXPECT_EQ(result["last"], Json({6, 0.6}));
  EXPECT_EQ(result["round"], 3);
  EXPECT_EQ(result["plays"], false);
}

// --- The page

TEST_F(ViewInBrowser, ZoomsToThePixelAndKeepsThePointUnderTheCursor) {
  Frame frame = small_frame(64, 48, {"depth", "ao"});
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) frame.views[0].planes.at("ao").channels[0].at(x, y) = float((x + y) % 2);
  write_frame(path("frame.exr"), frame);
  const Json result = page_of({"frame.exr"}, R"js(
    await choose('Plane of A', 'ao');
    const box = stage.getBoundingClientRect();
    const y = Math.floor(box.top) + 200, before = pointAt(300 - box.left, y - box.top);  // events have whole pixels
    for (let i = 0; i < 5; ++i)
      stage.dispatchEvent(new WheelEvent('wheel', {deltaY: -300, clientX: 300, clientY: y, bubbles: true, cancelable: true}));
    result.moved = Math.hypot(...pointAt(300 - box.left, y - box.top).map((at, i) => at - before[i]));
    result.zoom = looking().zoom;
    result.grid = [0, 1, 2, 3].map((x) => x + Math.floor(before[0])).map((x) => [x % 2, onScreenAt(x, Math.floor(before[1]))]);
    function onScreenAt(x, y) {
      drawStage();
      const [u, v] = placeIn(panes()[0], x + 0.08, y + 0.08);
      return pen.getImageData(Math.floor(u), Math.floor(v), 1, 1).data[0];
    }
    result.parity = Math.floor(before[1]) % 2;
    press('0');
    result.fits = state.zoom;
    press('1');
    result.one = looking().zoom * deviceScale();
    stage.focus();
    const arrow = (key, more) => stage.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, ...more}));
    press('0');
    arrow('ArrowRight');
    const start = state.picked;
    arrow('ArrowRight'), arrow('ArrowDown'), arrow('ArrowRight', {shiftKey: true});
    result.walked = state.picked.map((at, i) => at - start[i]);
    for (let i = 0; i < 20; ++i) arrow('ArrowRight', {shiftKey: true});
    result.edge = state.picked[0];
  )js");
  EXPECT_LT(result["moved"], 1e-9);
  EXPECT_GT(result["zoom"], 44);
  for (const Json& cell : result["grid"]) {
    const int expected = (cell[0].get<int>() + result["parity"].get<int>()) % 2 ? 255 : 0;
    EXPECT_NEAR(cell[1].get<int>(), expected, 3) << "pixels are squares of one colour";
  }
  EXPECT_EQ(result["fits"], nullptr);
  EXPECT_EQ(result["one"], 1);
  EXPECT_EQ(result["walked"], Json({11, 1}));
  EXPECT_EQ(result["edge"], 63);
}

TEST_F(ViewInBrowser, ComesBackAsTheAddressSays) {
  write_frame(path("frame.exr"), small_frame(32, 24, {"depth", "color", "ao"}));
  write_result("ao.exr", 0.75f);
  Json result = page_of({"frame.exr", "ao.exr"}, R"js(
    changeMode('beside');
    await choose('Plane of A', 'color');
    await choose('Plane of B', 'depth');
    const slider = document.querySelector('[aria-label="Exposure in stops"]');
    slider.value = -2;
    slider.dispatchEvent(new Event('input'));
    state.picked = [5, 6];
    zoomAt(100, 100, 3);
    changeMarks(false);
    keepAddress();
    await wait(300);
    result.address = location.hash.slice(1);
    result.looking = looking();
  )js");
  const std::string address = result["address"];
  const Json looking = result["looking"];
  const std::string tell = R"js(
    result.state = [state.a, state.b, state.mode, state.picked, state.marks, toneNow(shown.a).exposure];
    result.looking = looking();
  )js";
  result = page_of({"frame.exr", "ao.exr"}, tell, {1280, address});
  EXPECT_EQ(result["state"][0], Json({{"file", 0}, {"plane", "color"}, {"view", ""}}));
  EXPECT_EQ(result["state"][1], Json({{"file", 1}, {"plane", "depth"}, {"view", ""}}));
  EXPECT_EQ(result["state"][2], "beside");
  EXPECT_EQ(result["state"][3], Json({5, 6}));
  EXPECT_EQ(result["state"][4], false);
  EXPECT_EQ(result["state"][5], -2);
  EXPECT_NEAR(result["looking"]["zoom"], looking["zoom"], 1e-3);
  EXPECT_NEAR(result["looking"]["centre"][0], looking["centre"][0], 1e-3);
  // What no page says is taken for nothing.
  result = page_of(
      {"frame.exr", "ao.exr"}, tell,
      {1280,
       "a=9|x|y&b=-1&mode=no&zoom=1e99&pixel=a,b&wipe=7&frame=2&tone.color={\"map\":\"<b>\",\"low\":1e999}&tone.ao=x"});
  EXPECT_EQ(result["state"][2], "wipe");
  EXPECT_EQ(result["state"][0]["file"], 1);
}

TEST_F(ViewInBrowser, FitsATelephoneAndAsksForNothing) {
  write_frame(path("a file with a long name that goes on and on.exr"), small_frame(32, 24, {"depth", "color", "ao"}));
  write_result("b.exr", 0.75f);
  const Json result = page_of({"a file with a long name that goes on and on.exr", "b.exr"}, R"js(
    byId('keys').open = true;
    for (const mode of modes) {
      changeMode(mode);
      await showing;
    }
    result.wide = [...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.tagName + '#' + e.id + '.' + e.className);
    result.width = [document.documentElement.scrollWidth, innerWidth];
    result.requests = performance.getEntriesByType('resource').map((entry) => entry.name);
    result.keys = byId('keys').textContent;
  )js",
                              {420, ""});
  EXPECT_EQ(result["wide"], Json::array());
  EXPECT_LE(result["width"][0], result["width"][1]);
  EXPECT_EQ(result["requests"], Json::array());
  EXPECT_NE(result["keys"].get<std::string>().find("Shift+D"), std::string::npos);
}

TEST_F(ViewInBrowser, ShowsNotesCameraAndHeader) {
  Frame frame = small_frame(32, 24, {"depth", "ao"});
  frame.attributes["gloamParameters"] = "radius=0.5 </script><b>";
  write_frame(path("frame.exr"), frame);
  frame = small_frame(32, 24, {"depth", "normal"});
  write_frame(path("other.exr"), frame);
  const Json result = page_of(
      {"frame.exr"}, "result.about = byId('about').textContent; result.bold = document.querySelector('#about b');", {},
      {"--fov", "60"});
  const std::string about = result["about"];
  for (const char* words : {"frame.exr", "32 \u00d7 24", "perspective, --fov, hfov 60.00 deg",
                            "radius=0.5 </script><b>", "attributes of the header", "compression"})
    EXPECT_NE(about.find(words), std::string::npos) << words << "\n" << about;
  EXPECT_EQ(result["bold"], nullptr);
}

TEST_F(ViewInBrowser, ShowsOnePixel) {
  write_result("dot.exr", 0.75f, 1, 1);
  const Json result = page_of({"dot.exr"}, R"js(
    await choose('Plane of A', 'ao');
    drawStage();
    result.pixel = onScreen(0, 0.3)[0];
    point(0, 0);
    result.cells = cells()[0];
    stepSide('plane', 1);
    await showing;
  )js");
  EXPECT_NEAR(result["pixel"].get<int>(), 191, 1);
  EXPECT_EQ(result["cells"], Json({"ao", "0.75"}));
}

TEST_F(ViewInBrowser, ShowsALargeFrame) {
  Frame frame = small_frame(4096, 2160, {"ao"});
  Channel& ao = frame.views[0].planes.at("ao").channels[0];
  for (int y = 0; y < 2160; ++y)
    for (int x = 0; x < 4096; ++x) ao.at(x, y) = float((x / 64 + y / 64) % 5) / 4;
  ao.at(4095, 2159) = 0.123f;
  write_frame(path("large.exr"), frame);
  const Json result = page_of({"large.exr"}, R"js(
    point(4095, 2159);
    result.last = cells()[0][1];
    result.middle = onScreen(2080, 1056)[0];
  )js");
  EXPECT_EQ(result["last"], "0.123");
  EXPECT_NEAR(result["middle"].get<int>(), 255 * double((2080 / 64 + 1056 / 64) % 5) / 4, 1);
}

TEST_F(ViewInBrowser, StaysUsableWithTheViewsOfADisplay) {
  Frame frame = small_frame(24, 18, {"depth", "ao"});
  const std::optional<Camera> camera = frame.views[0].camera;
  std::map<std::string, Plane> planes = std::move(frame.views[0].planes);
  frame.views.clear();
  for (int i = 0; i < 48; ++i) {
    View view{fmt::format("module{:02}", i), camera, {}, {}, {}};
    for (const auto& [name, plane] : planes) view.planes[name] = plane.clone();
    view.planes.at("ao").channels[0].at(0, 0) = float(i) / 64;
    frame.views.push_back(std::move(view));
  }
  write_frame(path("display.exr"), frame);
  const Json result = page_of({"display.exr"}, R"js(
    await choose('Plane of A', 'ao');
    result.views = document.querySelector('[aria-label="View of A"]').options.length;
    await choose('View of A', 'module47');
    result.last = shown.a.channels[0][0];
    press('v');
    await showing;
    result.first = shown.a.channels[0][0];
    press('V', {shiftKey: true});
    await showing;
    result.before = state.a.view;
  )js");
  EXPECT_EQ(result["views"], 48);
  EXPECT_EQ(result["last"], 47.0 / 64);
  EXPECT_EQ(result["first"], 0);
  EXPECT_EQ(result["before"], "module47");
}

}  // namespace
}  // namespace gloam::test::view_test
