// The radius that every command uses by default, in any unit of a frame, and warnings about a radius that does not fit.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cmath>
#include <limits>

#include "cli/gloam_process.h"
#include "gloam/parameters.h"
#include "gloam/technique.h"
#include "support/long.h"

namespace gloam::test::radius_test {
namespace {

using Json = nlohmann::json;

constexpr double background_from = 1e9;  // Blender's background, in any unit

bool is_depth(const std::string& channel) { return channel == "Z" || channel.find("Depth.") != std::string::npos; }

void scale_attributes(Imf::Header& header, float factor) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (auto* matrix = dynamic_cast<Imf::M44fAttribute*>(&it.attribute())) {
      const bool to_camera = std::string(it.name()) == "worldToCamera";
      // Row vectors. A point in the new unit is a point in the old one times the factor.
      for (int column = 0; column < 4; ++column) {
        if (to_camera && column < 3)
          matrix->value()[3][column] *= factor;
        else if (!to_camera)
          for (int row = 0; row < 3; ++row) matrix->value()[row][column] /= factor;
      }
    } else if (auto* number = dynamic_cast<Imf::FloatAttribute*>(&it.attribute())) {
      const std::string name = it.name();
      if (name == "aoRadius" || name == "near" || name == "far") number->value() *= factor;
    }
  }
}

/// The same picture in a unit that is `factor` times smaller: depths, cameras, and the radius of a truth.
void write_scaled(const fs::path& from, const fs::path& to, float factor) {
  Imf::InputFile in(from.c_str());
  Imf::Header header = in.header();
  const Imath::Box2i window = header.dataWindow();
  const size_t width = size_t(window.max.x - window.min.x + 1), height = size_t(window.max.y - window.min.y + 1);
  std::map<std::string, std::vector<float>> channels;
  Imf::FrameBuffer buffer;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    it.channel().type = Imf::FLOAT;
    std::vector<float>& values = channels[it.name()];
    values.resize(width * height);
    char* base = reinterpret_cast<char*>(values.data()) - 4 * (size_t(window.min.y) * width + size_t(window.min.x));
    buffer.insert(it.name(), Imf::Slice(Imf::FLOAT, base, 4, 4 * width));
  }
  in.setFrameBuffer(buffer);
  in.readPixels(window.min.y, window.max.y);
  for (auto& [name, values] : channels) {
    for (float& value : values) {
      if (is_depth(name) && value < background_from) value *= factor;
    }
  }
  scale_attributes(header, factor);
  Imf::OutputFile out(to.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(int(height));
}

void scale_camera_json(const fs::path& from, const fs::path& to, double factor) {
  Json camera = Json::parse(slurp(from));
  for (const char* name : {"near", "far"}) camera[name] = double(camera[name]) * factor;
  for (Json& view : camera["views"]) {
    for (const char* matrix : {"camera_to_world", "world_to_camera"}) {
      for (int row = 0; row < 3; ++row) view[matrix][row][3] = double(view[matrix][row][3]) * factor;
    }
    view.erase("projection_gl");
  }
  for (const char* name : {"interocular_distance", "convergence_distance"})
    camera["stereo"][name] = double(camera["stereo"][name]) * factor;
  std::ofstream(to) << camera;
}

/// One frame and its truth, in its own unit and in a unit a thousand times smaller.
class Radius : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    for (const char* unit : {"metres", "millimetres"}) fs::create_directory(path(unit));
  }
  std::string file(const std::string& unit, const std::string& name) const { return (path(unit) / name).string(); }

  void use_loggia() {
    for (const auto& [unit, factor] : units()) {
      write_scaled(loggia, file(unit, "frame.exr"), factor);
      write_scaled(loggia_truth, file(unit, "truth.exr"), factor);
    }
  }
  /// False if the captures are missing.
  bool use_apartment() {
    const fs::path from = captures / "apartment_stereo";
    if (!fs::exists(from)) return false;
    for (const auto& [unit, factor] : units()) {
      write_scaled(from / "apartment_stereo_exact.exr", file(unit, "frame.exr"), factor);
      write_scaled(from / "apartment_stereo_ao_ref_left.exr", file(unit, "truth.exr"), factor);
      scale_camera_json(from / "camera_stereo.json", file(unit, "camera.json"), factor);
    }
    camera_ = true;
    return true;
  }

  static std::map<std::string, float> units() { return {{"metres", 1.0f}, {"millimetres", 1000.0f}}; }

  Result on_frame(const std::string& unit, Arguments arguments, const Arguments& more = {}) const {
    arguments.push_back(file(unit, "frame.exr"));
    return with_camera(unit, arguments, more);
  }
  Result with_camera(const std::string& unit, Arguments arguments, const Arguments& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (camera_) arguments.insert(arguments.end(), {"--camera", file(unit, "camera.json")});
    return gloam(arguments);
  }

  Json compared(const std::string& unit, const std::string& image) const {
    const Result result = gloam({"compare", file(unit, image), file(unit, "truth.exr"), "--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.json();
  }

  /// Errors of two commands, in both units.
  std::map<std::string, double> errors_of_run_and_auto(const std::string& unit, const Arguments& more = {}) const {
    std::map<std::string, double> errors;
    Arguments techniques = {"ssao", "alchemy", "sao", "hbao", "hbao+", "gtao", "bitmask", "volumetric"};
    techniques.insert(techniques.end(), more.begin(), more.end());
    for (const std::string& technique : techniques) {
      const Result result = on_frame(unit, {"run", technique}, {"-o", file(unit, "ao.exr")});
      EXPECT_EQ(result.status, 0) << result.err;
      errors["run " + technique] = compared(unit, "ao.exr")["rmse"];
    }
    EXPECT_EQ(on_frame(unit, {"auto"}, {"-o", file(unit, "auto.exr")}).status, 0);
    errors["auto"] = compared(unit, "auto.exr")["rmse"];
    return errors;
  }
  std::map<std::string, double> errors_of_bench_and_pick(const std::string& unit, const Arguments& view) const {
    std::map<std::string, double> errors;
    Arguments more = {"-o",
                      file(unit, "bench"),
                      "--techniques",
                      "hbao+,gtao",
                      "--presets",
                      "medium",
                      "--rounds",
                      "1",
                      "--variants",
                      "none",
                      "--no-growth",
                      "--no-checks",
                      "--ladder",
                      "none",
                      "--no-images",
                      "--frame",
                      file(unit, "frame.exr"),
                      "--truth",
                      file(unit, "truth.exr")};
    more.insert(more.end(), view.begin(), view.end());
    const Result bench = with_camera(unit, {"bench", "--all"}, more);
    EXPECT_EQ(bench.status, 0) << bench.err;
    const Json measured = Json::parse(slurp(file(unit, "bench/bench.json")));
    for (const Json& row : measured.at("results"))
      errors["bench " + std::string(row.at("technique"))] = row.at("rmse_to_truth");
    for (const bool knows_truth : {true, false}) {
      Arguments searching = {"--all", "--error", "0.5", "--techniques", "hbao", "--rounds", "1", "--json", "-"};
      if (knows_truth) searching.insert(searching.end(), {"--truth", file(unit, "truth.exr")});
      searching.insert(searching.end(), view.begin(), view.end());
      const Result pick = on_frame(unit, {"pick"}, searching);
      EXPECT_EQ(pick.status, 0) << pick.err;
      const Json picked = pick.json();
      for (const Json& row : picked.at("finalists")) {
        const std::string setting = std::string(row.at("preset")) + " " + std::string(row.at("resolution"));
        errors["pick " + setting + (knows_truth ? "" : ", no truth")] = row.at("rmse");
      }
    }
    return errors;
  }
  static void expect_alike(const std::map<std::string, double>& metres, const std::map<std::string, double>& other) {
    ASSERT_EQ(metres.size(), other.size());
    ASSERT_GE(metres.size(), 3u);
    for (const auto& [what, error] : metres) {
      EXPECT_GT(error, 0.01) << what;
      EXPECT_NEAR(other.at(what), error, 0.1 * error) << what;
    }
  }

  bool camera_ = false;
};

TEST_F(Radius, RunAndAutoReadTheSameErrorInMillimetresAsInMetres) {
  use_loggia();
  const auto metres = errors_of_run_and_auto("metres");
  expect_alike(metres, errors_of_run_and_auto("millimetres"));
  EXPECT_LT(metres.at("run gtao"), 0.18) << "a white image reads 0.25";
}

TEST_F(Radius, BenchAndPickReadTheSameErrorInMillimetresAsInMetres) {
  use_loggia();
  expect_alike(errors_of_bench_and_pick("metres", {}), errors_of_bench_and_pick("millimetres", {}));
}

TEST_F(Radius, ARealFrameReadsTheSameErrorInMillimetresAsInMetres) {
  if (!use_apartment()) GTEST_SKIP() << "no captures at " << captures;
  const Arguments stereo = {"stereo-ao", "stereo-gtao", "stereo-bitmask"};
  auto metres = errors_of_run_and_auto("metres", stereo), millimetres = errors_of_run_and_auto("millimetres", stereo);
  if (is_long_run()) {  // the test before this one has both commands on a smaller frame
    metres.merge(errors_of_bench_and_pick("metres", {"--view", "left"}));
    millimetres.merge(errors_of_bench_and_pick("millimetres", {"--view", "left"}));
  }
  for (const auto& [what, error] : metres) RecordProperty("metres " + what, std::to_string(error));
  for (const auto& [what, error] : millimetres) RecordProperty("millimetres " + what, std::to_string(error));
  expect_alike(metres, millimetres);
}

TEST_F(Radius, EveryCommandTellsTheSameDefaultInItsUnit) {
  use_loggia();
  for (const auto& [unit, factor] : units()) {
    std::map<std::string, Json> said = {
        {"info", on_frame(unit, {"info"}, {"--json", "-"}).json()},
        {"plan", on_frame(unit, {"plan", "gtao"}, {"--json", "-"}).json()},
        {"run", on_frame(unit, {"run", "gtao"}, {"-o", file(unit, "ao.exr"), "--json", "-"}).json()},
        {"auto", on_frame(unit, {"auto"}, {"-o", file(unit, "auto.exr"), "--json", "-"}).json()},
        {"pick",
         on_frame(unit, {"pick"}, {"--techniques", "hbao+", "--error", "0.9", "--rounds", "1", "--json", "-"}).json()}};
    for (const auto& [command, document] : said) {
      ASSERT_TRUE(document.contains("radius")) << command;
      EXPECT_NEAR(document["radius"], 0.39 * factor, 1e-6 * factor) << command;
      EXPECT_EQ(document["radius_from"], "frame") << command;
      EXPECT_NEAR(document["radius_pixels"], 480 / 16.0, 1) << command;
    }
  }
  for (const Arguments& command : {Arguments{"info"}, Arguments{"plan", "gtao"}, Arguments{"run", "gtao"}}) {
    const Result result =
        on_frame("metres", command, command[0] == "run" ? Arguments{"-o", file("metres", "ao.exr")} : Arguments{});
    EXPECT_NE(result.out.find("radius 0.39 scene units (made from the frame): 30 pixels at the median depth\n"),
              std::string::npos)
        << result.out;
  }
}

TEST_F(Radius, OfTheTruthComesBeforeTheFrames) {
  use_loggia();
  const Json picked = on_frame("millimetres", {"pick"},
                               {"--techniques", "hbao+", "--error", "0.9", "--rounds", "1", "--truth",
                                file("millimetres", "truth.exr"), "--json", "-"})
                          .json();
  EXPECT_NEAR(picked["radius"], 500, 0.01);
  EXPECT_EQ(picked["radius_from"], "truth");
}

TEST_F(Radius, OfTheSceneTravelsWithTheFrame) {
  const std::string frame = path("scene.exr").string();
  ASSERT_EQ(gloam({"capture", "fence", "--size", "96x54", "-o", frame}).status, 0);
  const Json run = gloam({"run", "gtao", frame, "-o", path("ao.exr"), "--json", "-"}).json();
  EXPECT_EQ(run["radius_from"], "scene");
  EXPECT_EQ(run.at("radius"), gloam({"info", frame, "--json", "-"}).json()["radius"]);
  const Json flag = gloam({"run", "gtao", frame, "-o", path("ao.exr"), "--radius", "0.7", "--json", "-"}).json();
  EXPECT_NEAR(flag["radius"], 0.7, 1e-6);
  EXPECT_EQ(flag["radius_from"], "flag");
  ASSERT_EQ(gloam({"reference", "ao", frame, "--samples", "32", "-o", path("truth.exr")}).status, 0);
  EXPECT_NEAR(*FrameFile(path("truth.exr"), {}).number_attribute("aoRadius"), double(run["radius"]), 1e-6);
}

TEST_F(Radius, AHeaderThatStatesNoRadiusIsPassedOverWithANote) {
  Imf::InputFile in(loggia.c_str());
  use_loggia();
  for (const float nonsense : {-1.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Frame frame = FrameFile(loggia, {}).read({"depth", "normal"});
    frame.numbers["aoRadius"] = nonsense;
    write_frame(path("odd.exr"), frame);
    const Result result = gloam({"run", "gtao", path("odd.exr"), "-o", path("ao.exr"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["radius_from"], "frame");
    EXPECT_NE(result.err.find("note: odd.exr: aoRadius "), std::string::npos) << result.err;
  }
}

/// A command's message about a radius on the loggia, whose camera and normals need no note.
class RadiusNote : public Radius {
 protected:
  void SetUp() override {
    Radius::SetUp();
    use_loggia();
  }
  std::map<std::string, Result> everywhere(const std::string& radius, const std::string& unit = "metres") const {
    const auto with = [&](Arguments more) {
      more.insert(more.end(), {"--radius", radius});
      return more;
    };
    return {{"run", on_frame(unit, {"run", "gtao"}, with({"-o", file(unit, "ao.exr")}))},
            {"plan", on_frame(unit, {"plan", "gtao"}, with({}))},
            {"auto", on_frame(unit, {"auto"}, with({"-o", file(unit, "auto.exr")}))},
            {"pick", on_frame(unit, {"pick"}, with({"--techniques", "hbao+", "--error", "0.9", "--rounds", "1"}))},
            {"bench", gloam(with({"bench", "--all", "--frame", file(unit, "frame.exr"), "-o", file(unit, "bench"),
                                  "--techniques", "hbao+", "--presets", "medium", "--rounds", "1", "--variants", "none",
                                  "--no-growth", "--no-checks", "--ladder", "none", "--no-images"}))}};
  }
  /// Commands that measure errors need a radius that has an effect.
  void expect_note_or_refusal(const std::string& radius, const std::string& golden) const {
    for (const auto& [command, result] : everywhere(radius)) {
      const bool measures = command == "bench" || command == "pick";
      EXPECT_EQ(result.status, measures ? 2 : 0) << command << result.err;
      const std::string said = measures ? "gloam: --radius " + radius + " is not allowed" : "note: " + golden + "\n";
      EXPECT_NE(result.err.find(said), std::string::npos) << command << ": " << result.err;
    }
  }
  void expect_note(const std::string& radius, const std::string& golden, const std::string& unit = "metres") const {
    for (const auto& [command, result] : everywhere(radius, unit)) {
      EXPECT_EQ(result.status, 0) << command << result.err;
      EXPECT_NE(result.err.find("note: " + golden + "\n"), std::string::npos) << command << ": " << result.err;
    }
  }
};

TEST_F(RadiusNote, UnderTwoPixels) {
  expect_note("0.02",
              "radius 0.02 scene units reaches 1.54 pixels at the median depth: few occluders are that near; "
              "--radius 0.39 reaches 30");
}

TEST_F(RadiusNote, OfMetresOnAFrameInMillimetres) {
  expect_note("20",
              "radius 20 scene units reaches 1.54 pixels at the median depth: few occluders are that near; "
              "--radius 390 reaches 30",
              "millimetres");
  expect_note("45",
              "radius 45 scene units reaches 3.47 pixels at the median depth: few occluders are that near; "
              "--radius 390 reaches 30",
              "millimetres");
}

TEST_F(RadiusNote, OverTheCap) {
  expect_note("20",
              "radius 20 scene units reaches 1541 pixels at the median depth, but most pixels are searched only up to "
              "120 (max_reach 0.25); --radius 0.39 reaches 30");
}

TEST_F(RadiusNote, Zero) {
  expect_note_or_refusal("0",
                         "radius 0: nothing is within reach, so AO is 1 everywhere; --radius 0.39 reaches 30 pixels");
}

TEST_F(RadiusNote, Infinity) {
  expect_note_or_refusal("inf",
                         "radius inf: every occluder counts that lies within 120 pixels, which is max_reach 0.25");
}

TEST_F(RadiusNote, NoneWhereTheRadiusFits) {
  for (const auto& [command, result] : everywhere("0.5"))
    EXPECT_EQ(result.err.find("note: radius"), std::string::npos) << command << ": " << result.err;
  for (const auto& [command, result] : everywhere("400", "millimetres"))
    EXPECT_EQ(result.err.find("note: radius"), std::string::npos) << command << ": " << result.err;
}

TEST_F(RadiusNote, StandsInTheDocumentToo) {
  const Json run =
      on_frame("metres", {"run", "gtao"}, {"-o", file("metres", "ao.exr"), "--radius", "0.02", "--json", "-"}).json();
  ASSERT_FALSE(run["notes"].empty());
  EXPECT_EQ(std::string(run["notes"].back()).rfind("radius 0.02 scene units reaches", 0), 0u) << run["notes"];
}

/// `list` does not know the frame.
TEST_F(Radius, OfTheListIsTheFrames) {
  for (const Json& technique : gloam({"list", "techniques", "--json", "-"}).json()) {
    for (const Json& parameter : technique["parameters"]) {
      if (parameter["name"] != "radius" || parameter["unit"] != "scene units") continue;
      EXPECT_TRUE(parameter["default"].is_null()) << technique["name"];
      EXPECT_EQ(parameter.value("default_from", ""), "frame") << technique["name"];
    }
  }
}

}  // namespace
}  // namespace gloam::test::radius_test
