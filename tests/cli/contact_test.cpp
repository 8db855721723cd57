// The light of contact shadows at the command line: the sun in a captured header, and what is told where nothing states a light.
#include <glm/geometric.hpp>

#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::contact_test {
namespace {

class CliContact : public Cli {
 protected:
  Result run(const std::string& frame, Arguments more = {}) const {
    Arguments arguments = {"run", "contact-shadow", frame, "-o", path("contact.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
};

TEST_F(CliContact, TakesTheSunThatTheCaptureWrites) {
  const std::string frame = path("courtyard.exr");
  ASSERT_EQ(gloam({"capture", "courtyard", "-o", frame, "--size", "64x36"}).status, 0);
  const std::optional<glm::dvec3> light = FrameFile(frame, {}).read({"depth"}).views[0].light;
  ASSERT_TRUE(light);
  EXPECT_LT(glm::distance(*light, glm::normalize(glm::dvec3(0.5, 1, 0.55))), 1e-6);
  const Result result = run(frame, {"--length", "0.5"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err.find("light"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("length 0.5 scene units (given)"), std::string::npos) << result.out;
  // A result is of the same scene under the same sun.
  EXPECT_EQ(FrameFile(path("contact.exr"), {}).read({"contact"}).views[0].light, light);
  EXPECT_NE(run(frame, {"--light_x", "1"}).err.find("have no effect with light sun"), std::string::npos);
}

TEST_F(CliContact, SaysWhereLightComesFromWhereNothingStatesIt) {
  Frame frame = shoot(perspective(97, 65), room());
  frame.views[0].camera->pose.emplace();
  write_frame(path("posed.exr"), frame);
  EXPECT_NE(run(path("posed.exr")).err.find("states no sun (gloamLight), so light comes from 0,1,0 in the world"),
            std::string::npos);
  frame.views[0].camera->pose.reset();
  write_frame(path("free.exr"), frame);
  EXPECT_NE(
      run(path("free.exr")).err.find("the pose of the camera is unknown, so light comes from 0,1,0 in view space"),
      std::string::npos);
  const Result point = run(path("free.exr"), {"--light", "point"});
  EXPECT_NE(point.err.find("light_x, light_y and light_z are taken for view space"), std::string::npos) << point.err;
  const Result zero = run(path("free.exr"), {"--light", "directional", "--light_y", "0"});
  EXPECT_NE(zero.status, 0);
  EXPECT_NE(zero.err.find("light_x, light_y and light_z are all 0"), std::string::npos) << zero.err;
}

}  // namespace
}  // namespace gloam::test::contact_test
