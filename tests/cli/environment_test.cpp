// Light of an environment at the command line: a scene's own sky, which the light and reflections take as a map, and what is told about maps
// that are none.
#include <fstream>
#include <glm/geometric.hpp>

#include "cli/gloam_process.h"
#include "gloam/environment_file.h"
#include "support/stress.h"

namespace gloam::test::environment_test {
namespace {

class CliEnvironment : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path("f.exr"), "--sky", path("sky.exr"), "--size", "64x36"}).status,
              0);
  }

  Result run(Arguments arguments) const {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"-o", path("out.exr")});
    return gloam(arguments);
  }

  Result light(Arguments more = {}) const {
    more.insert(more.begin(), {"environment", path("f.exr")});
    return run(more);
  }
};

// The sky of gallery: its zenith is bluer than its horizon, its ground darker.
TEST_F(CliEnvironment, ASkyIsAMapWithUpAbove) {
  const EnvironmentMap sky = read_environment(path("sky.exr"));
  const glm::dvec3 above = sky.radiance({0, 1, 0}), aside = sky.radiance({1, 0.02, 0}),
                   below = sky.radiance({0, -1, 0});
  EXPECT_GT(above.z / above.x, 1.01 * aside.z / aside.x);
  EXPECT_LT(below.x, aside.x);
  EXPECT_NE(gloam({"info", path("sky.exr")}).out.find("color"), std::string::npos);
}

TEST_F(CliEnvironment, LightOfTheSky) {
  const Result result = light({"--environment", path("sky.exr")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err.find("environment:"), std::string::npos) << result.err;
  const Frame frame = FrameFile(path("out.exr"), {}).read({"environment", "environment_raw"});
  EXPECT_GT(frame.views[0].planes.at("environment").channels[2].at(32, 18), 0.1f);
}

TEST_F(CliEnvironment, SaysWhatItTakesForTheLight) {
  EXPECT_NE(light().err.find("no map is given, so light is 1 from all around; give --environment FILE, a lat-long map"),
            std::string::npos);
  EXPECT_NE(light({"--environment_turn", "30"}).err.find("have no effect without a map"), std::string::npos);
  Frame frame = shoot(perspective(65, 49), room());
  write_frame(path("free.exr"), frame);
  EXPECT_NE(run({"environment", path("free.exr"), "--environment", path("sky.exr")})
                .err.find("the pose of the camera is unknown, so up in the image is up in the map"),
            std::string::npos);
  EXPECT_NE(run({"sssr", path("f.exr"), "--environment", path("sky.exr"), "--environment_r", "1"})
                .err.find("environment_r, _g and _b have no effect with a map"),
            std::string::npos);
}

TEST_F(CliEnvironment, RefusesWhatIsNoMap) {
  for (const char* technique : {"environment", "sssr"}) {
    const auto refusal = [&](const std::string& map) {
      const Result result = run({technique, path("f.exr"), "--environment", map});
      EXPECT_NE(result.status, 0);
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      return result.err;
    };
    EXPECT_NE(refusal(path("none.exr")).find("none.exr: "), std::string::npos);
    EXPECT_NE(refusal(path("f.exr")).find("is 64 x 36 and no lat-long environment"), std::string::npos);
    std::ofstream(path("text.exr")) << "no image";
    EXPECT_NE(refusal(path("text.exr")).find("text.exr"), std::string::npos);
    const Result axes = run({technique, path("f.exr"), "--environment_axes", "maya"});
    EXPECT_NE(axes.status, 0);
    EXPECT_NE(axes.err.find("openexr, blender"), std::string::npos) << axes.err;
  }
}

TEST_F(CliEnvironment, RefusesANameThatIsNoSky) {
  const auto refusal = [&](const std::string& sky) {
    return gloam({"capture", "plane", "-o", path("g.exr"), "--size", "16x9", "--sky", sky}).err;
  };
  EXPECT_NE(refusal(path("sky.png")).find("--sky"), std::string::npos);
  EXPECT_NE(refusal(path("sky.####.exr")).find("is the name of many files, and the sky is one"), std::string::npos);
  EXPECT_NE(refusal(path("g.exr")).find("--sky"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::environment_test
