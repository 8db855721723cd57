// gloam run --history: a sequence, frame after frame.
#include <fmt/format.h>

#include "cli/gloam_process.h"
#include "support/long.h"

namespace gloam::test::history_test {
namespace {

using Json = nlohmann::json;

class History : public Cli {
 protected:
  /// An eye that walks through the gallery, 2.5 cm a frame.
  void walk(int frames, const std::string& size) {
    const double end = 0.025 * (frames - 1);
    const auto key = [](double x) {
      return fmt::format(R"({{"camera_to_world": [[1,0,0,{}],[0,1,0,1.6],[0,0,1,2],[0,0,0,1]]}})", x);
    };
    std::ofstream(path("path.json")) << fmt::format(
        R"({{"width": 320, "height": 180, "fx": 220, "fy": 220, "cx": 160, "cy": 90, "frames": {}, "path": [{}, {}]}})",
        frames, key(0), key(end));
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path("f.exr"), "--size", size, "--camera-path", path("path.json"),
                     "--planes", "depth,normal,color,roughness,reflectance,motion"})
                  .status,
              0);
  }
  fs::path frame(int number) const { return path(fmt::format("f.{:04}.exr", number)); }
  fs::path result(int number) const { return path(fmt::format("r.{:04}.exr", number)); }
};

TEST_F(History, ASequenceComesNearerToTheTruthThanItsFrames) {
  ONLY_IN_LONG_RUN();
  constexpr int last = 6;
  walk(last, "320x180");
  ASSERT_EQ(gloam({"run", "sssr", frame(1), "-o", result(1), "--keep-depth"}).status, 0);
  for (int i = 2; i <= last; ++i) {
    const Result run = gloam({"run", "temporal-sssr", frame(i), "--history", result(i - 1), "-o", result(i)});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  EXPECT_NE(FrameFile(result(last), {}).text_attribute("gloamRun").find("seed=5"), std::string::npos)
      << "each frame has other random numbers";
  const Frame made_of = FrameFile(result(last), {}).read({"frames"});
  long all = 0, some = 0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 320; ++x) {
      const float frames = made_of.views[0].planes.at("frames").channels[0].at(x, y);
      EXPECT_LE(frames, last + 1e-3f);
      some += frames >= 1;
      all += frames > last - 0.5f;
    }
  }
  EXPECT_GT(double(all), 0.6 * double(some));

  ASSERT_EQ(gloam({"run", "sssr", frame(last), "-o", path("alone.exr"), "--seed", "5", "--keep-depth"}).status, 0);
  ASSERT_EQ(
      gloam({"reference", "reflection", frame(last), "--scene", "gallery", "--samples", "64", "-o", path("truth.exr")})
          .status,
      0);
  const auto compared = [&](const fs::path& test) {
    return gloam({"compare", test, path("truth.exr"), "--plane", "reflection", "--json", "-"}).json();
  };
  const Json alone = compared(path("alone.exr")), sequence = compared(result(last));
  std::printf("SSIM %.4f and %.4f, RMSE %.5f and %.5f\n", double(alone["ssim"]), double(sequence["ssim"]),
              double(alone["rmse"]), double(sequence["rmse"]));
  EXPECT_GT(sequence["ssim"], double(alone["ssim"]) + 0.03);
  EXPECT_LT(sequence["rmse"], double(alone["rmse"]) * 1.02);
}

TEST_F(History, IsPlannedAndRefusedInOneLine) {
  walk(2, "32x18");
  const auto refused = [&](const Arguments& arguments, int status, const std::string& word) {
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  };
  const Arguments run = {"run", "temporal-sssr", frame(2), "-o", result(2)};
  refused(run, 1, "(gloam run --history PREVIOUS.exr makes 'history', 'history_depth' and 'history_frames'; see");
  const auto with = [&](Arguments more) {
    more.insert(more.begin(), run.begin(), run.end());
    return more;
  };
  refused(with({"--history", frame(1)}), 1, "has no 'reflection', 'ao_raw' or 'indirect_raw'");
  refused(with({"--history", path("none.exr")}), 1, "none.exr");
  ASSERT_EQ(gloam({"run", "sssr", frame(1), "-o", result(1), "--keep-depth"}).status, 0);
  refused(with({"--history", result(1), "--resolution", "half"}), 2, "--resolution");
  refused(with({"--history", result(2)}), 2, "is also --history");
  EXPECT_EQ(files(), (std::vector<std::string>{"f.0001.exr", "f.0002.exr", "path.json", "r.0001.exr"}));
  const Result unused = gloam({"run", "normals", frame(2), "--history", result(1), "-o", path("unused.exr")});
  EXPECT_EQ(unused.status, 0);
  EXPECT_NE(unused.err.find("'normals' takes nothing over"), std::string::npos) << unused.err;
  const Json plan = gloam({"plan", "temporal-sssr", frame(2), "--history", result(1), "--json", "-"}).json();
  EXPECT_EQ(plan["passes"].back()["name"], "temporal-sssr/accumulate");
  EXPECT_NE(plan.dump().find("r.0001.exr: reflection.R"), std::string::npos) << plan;
  EXPECT_EQ(plan.dump().find("r.0001.exr: frames"), std::string::npos) << "the file has none";
  ASSERT_EQ(gloam(with({"--history", result(1)})).status, 0);
  ASSERT_EQ(gloam({"capture", "gallery", "-o", path("small.exr"), "--size", "16x9"}).status, 0);
  ASSERT_EQ(gloam({"run", "sssr", path("small.exr"), "-o", path("small_r.exr"), "--keep-depth"}).status, 0);
  refused(with({"--history", path("small_r.exr")}), 1, "shows 16x9 pixels from (0, 0), and the frame 32x18");
  refused({"auto", frame(2), "--history", result(1), "-o", path("auto.exr")}, 2, "auto takes nothing over");
}

}  // namespace
}  // namespace gloam::test::history_test
