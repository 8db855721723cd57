// Frames of few pixels (host/frame/subsample.h): each shows the same points.
#include "frame/subsample.h"

#include <gtest/gtest.h>

namespace gloam::test::subsample_test {
namespace {

/// Sizes that the scale does not divide; planes that begin left of and above the display window.
Frame frame_of(const Camera& camera, int x0, int y0) {
  Frame frame;
  frame.display = {0, 0, 10, 7};
  frame.window = {x0, y0, 10, 7};
  View& view = frame.views.emplace_back();
  view.camera = camera;
  Channel depth(Layout(frame.width(), frame.height()), 0);
  for (int y = 0; y < frame.height(); ++y)
    for (int x = 0; x < frame.width(); ++x) depth.at(x, y) = float(1 + x + 100 * y);
  Plane plane{"depth", {}};
  plane.channels.push_back(std::move(depth));
  view.planes["depth"] = std::move(plane);
  return frame;
}

TEST(Subsample, PixelsKeepTheirPlaceInTheWorld) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.fx = 9;
    camera.fy = 8;
    camera.cx = 4.7;
    camera.cy = 3.1;
    for (const int scale : {1, 2, 3, 4}) {
      const Frame frame = frame_of(camera, -3, -2);
      const Frame small = every_nth_pixel(frame, scale, {"depth"});
      ASSERT_EQ(small.width(), (frame.width() + scale - 1) / scale);
      ASSERT_EQ(small.height(), (frame.height() + scale - 1) / scale);
      const Camera& reduced = *small.views[0].camera;
      const Channel &all = frame.views[0].find("depth")->channels[0], &few = small.views[0].find("depth")->channels[0];
      for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < small.width(); ++x) {
          ASSERT_EQ(few.at(x, y), all.at(x * scale, y * scale));
          // The ray through the pixel's centre.
          const double own = (x + 0.5 - reduced.cx) / reduced.fx, whole = (x * scale + 0.5 - 3 - camera.cx) / camera.fx;
          ASSERT_NEAR(own, whole, 1e-12) << x;
          const double up = (y + 0.5 - reduced.cy) / reduced.fy,
                       whole_up = (y * scale + 0.5 - 2 - camera.cy) / camera.fy;
          ASSERT_NEAR(up, whole_up, 1e-12) << y;
        }
      }
    }
  }
}

TEST(Subsample, APlaneThatIsNotThereIsLeftOut) {
  const Frame frame = frame_of(Camera{.fx = 1, .fy = 1}, 0, 0);
  EXPECT_EQ(every_nth_pixel(frame, 2, {"color"}).views[0].planes.size(), 0u);
}

}  // namespace
}  // namespace gloam::test::subsample_test
