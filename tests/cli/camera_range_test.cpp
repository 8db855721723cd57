// Within the allowed range of cameras and depths (docs/gbuffer.md), every plane is finite; outside it they are refused.
#include <cmath>

#include "gloam/error.h"
#include "gloam_process.h"

namespace gloam::test::camera_range_test {
namespace {

class CameraRange : public Cli {
 protected:
  /// Surfaces at depths from a thousandth to a thousand times `depth`, side by side.
  void write(double depth) {
    Frame frame = small_frame(48, 20, {"depth"});
    frame.views[0].camera.reset();
    Channel& z = frame.views[0].planes["depth"].channels[0];
    unsigned random = 1;
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 48; ++x) {
        random = random * 1664525u + 1013904223u;
        const double step = random >> 28 == 0 ? 1000 : random >> 28 == 1 ? 0.001 : 1 + 1e-3 * x;
        z.at(x, y) = float(std::min(depth * step, 3e38));
      }
    write_frame(path("frame.exr"), frame);
  }

  void write_camera(const std::string& intrinsics) {
    std::ofstream(path("one.json")) << "{" << intrinsics
                                    << ", \"camera_to_world\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}";
  }

  void expect_finite(const std::string& technique, const Arguments& flags, const std::string& what) {
    Arguments arguments = {"run", technique, path("frame.exr"), "-o", path("out.exr")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Result run = gloam(arguments);
    ASSERT_EQ(run.status, 0) << what << run.err;
    for (const auto& plane : gloam({"info", path("out.exr"), "--json", "-"}).json().at("planes")) {
      if (plane.at("name") == "depth") continue;
      EXPECT_EQ(plane.at("nonfinite"), 0) << what << " " << technique << " " << plane;
    }
  }
};

TEST_F(CameraRange, EveryPlaneIsFiniteWithinIt) {
  for (const double depth : {1e-27, 1.0, 9e6}) {
    write(depth);
    for (const char* camera :
         {R"("fx": 1e-6, "fy": 1e-6, "cx": 24, "cy": 10)", R"("fx": 1e-6, "fy": 1e7, "cx": -1e6, "cy": 1e6)",
          R"("fx": 1e7, "fy": 1e7, "cx": 1e6, "cy": -1e6)", R"("pixels_per_unit": 1e-12, "cx": 24, "cy": 10)",
          R"("pixels_per_unit": 1e12, "cx": 24, "cy": 10)"}) {
      write_camera(camera);
      for (const char* technique : {"normals", "positions", "gtao"})
        expect_finite(technique, {"--camera", path("one.json")}, fmt::format("{} at {:g}", camera, depth));
    }
    for (const char* degrees : {"1", "179"})
      expect_finite("normals", {"--fov", degrees}, fmt::format("--fov {} at {:g}", degrees, depth));
  }
}

TEST_F(CameraRange, EveryPlaneIsFiniteWhateverBackgroundIs) {
  for (const double depth : {1e12, 9e16, 1e25, 1e37}) {
    write(depth);
    write_camera(R"("fx": 1e-6, "fy": 1e-6, "cx": 1e6, "cy": 10)");
    for (const char* technique : {"normals", "positions", "gtao"})
      expect_finite(technique, {"--camera", path("one.json"), "--background", "3e38"}, fmt::format("at {:g}", depth));
  }
}

TEST_F(CameraRange, BeyondItIsRefusedWithTheRange) {
  write(1);
  const std::map<std::string, std::string> faults = {
      {R"("fx": 9e-7, "fy": 1, "cx": 1, "cy": 1)", "fx is 9e-07; expected 1e-6 to 1e7 pixels"},
      {R"("fx": 1, "fy": 2e7, "cx": 1, "cy": 1)", "fy is 2e+07; expected 1e-6 to 1e7 pixels"},
      {R"("fx": 1, "fy": 1, "cx": 2e6, "cy": 1)", "cx is 2e+06; expected at most 1e6 pixels"},
      {R"("pixels_per_unit": 1e13, "cx": 1, "cy": 1)", "pixels_per_unit is 1e+13; expected 1e-12 to 1e12"}};
  for (const auto& [camera, message] : faults) {
    write_camera(camera);
    const Result result =
        gloam({"run", "normals", path("frame.exr"), "-o", path("o.exr"), "--camera", path("one.json")});
    EXPECT_EQ(result.status, 1) << camera;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  }
}

TEST_F(CameraRange, HoldsInPixelsOfTheFrame) {
  write(1);
  write_camera(R"("fx": 1, "fy": 1, "cx": 24, "cy": 10, "width": 48e9, "height": 20e9)");
  const Result result = gloam({"run", "normals", path("frame.exr"), "-o", path("o.exr"), "--camera", path("one.json")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("for the frame's 48x20 that makes fx 1e-09 fy 1e-09"), std::string::npos) << result.err;
}

TEST_F(CameraRange, HoldsForHeaders) {
  Frame frame = small_frame(48, 20, {"depth"});
  frame.views[0].camera->pose = Pose();
  frame.views[0].camera->cx = 1e9;
  write_frame(path("frame.exr"), frame);
  const Result result = gloam({"run", "normals", path("frame.exr"), "-o", path("o.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("worldToNDC: has the principal point at (1e+09, 10)"), std::string::npos) << result.err;
}

TEST_F(CameraRange, OfFovIsNamed) {
  write(1);
  for (const char* degrees : {"0", "0.999", "179.5", "180", "-60", "nan", "inf", "wide"}) {
    const Result result = gloam({"run", "normals", path("frame.exr"), "-o", path("o.exr"), "--fov", degrees});
    EXPECT_EQ(result.status, 2) << degrees;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find(fmt::format("--fov {} is not allowed; a number from 1 to 179", degrees)),
              std::string::npos)
        << result.err;
  }
}

TEST_F(CameraRange, OfBackgroundIsThatOfFloat) {
  write(1);
  const Result result =
      gloam({"run", "normals", path("frame.exr"), "-o", path("o.exr"), "--fov", "60", "--background", "1e39"});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("--background 1e39 is not allowed; "), std::string::npos) << result.err;
}

}  // namespace
}  // namespace gloam::test::camera_range_test
