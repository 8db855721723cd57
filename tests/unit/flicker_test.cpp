// Flicker against closed forms: sequences whose error and motion are known.
#include "gloam/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "unit/message_of.h"

namespace gloam::test::flicker_test {
namespace {

constexpr int width = 24, height = 16, all_pixels = width * height;

using Values = std::function<float(int x, int y)>;

Channel channel_with(const Values& values, int columns = width) {
  Channel channel(Layout(columns, height), std::numeric_limits<float>::quiet_NaN());  // padding is not read
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < columns; ++x) channel.at(x, y) = values(x, y);
  return channel;
}

Plane ao_with(const Values& values, int columns = width) {
  Plane plane{"ao", {}};
  plane.channels.push_back(channel_with(values, columns));
  return plane;
}

Plane motion_with(const Values& x, const Values& y) {
  Plane plane{"motion", {}};
  plane.channels.push_back(channel_with(x));
  plane.channels.push_back(channel_with(y));
  return plane;
}

Values constant(float value) {
  return [value](int, int) { return value; };
}

SequenceFramePlanes frame_with(const Values& test, const Values& truth) {
  return {ao_with(test), ao_with(truth), Mask(size_t(all_pixels), 1), {Window{0, 0, width, height}, {}, {}, {}}};
}

/// A pattern without repetitions.
float texture(int x, int y) {
  return 0.5f + 0.25f * std::sin(0.7f * float(x) + 1.9f * float(y) + 0.05f * float(x * y));
}

TEST(Flicker, OfAnErrorThatChangesItsSignIsTwiceTheError) {
  FlickerMeter meter;
  for (int n = 0; n < 4; ++n) {
    const std::optional<FlickerSums> pair =
        meter.add(frame_with(constant(n % 2 ? 0.5f + 0.125f : 0.5f - 0.125f), constant(0.5f)));
    ASSERT_EQ(pair.has_value(), n > 0);
    if (!pair) continue;
    EXPECT_EQ(pair->flicker(), 0.25);
    EXPECT_EQ(pair->truth_change(), 0);
    EXPECT_EQ(pair->share(), 1);
    EXPECT_EQ(meter.source(), MotionSource::still);
  }
}

TEST(Flicker, OfTheTruthItselfIsNoneThoughItChanges) {
  FlickerMeter meter;
  const Values first = texture, second = [](int x, int y) { return 1 - texture(x, y); };
  meter.add(frame_with(first, first));
  const std::optional<FlickerSums> pair = meter.add(frame_with(second, second));
  EXPECT_EQ(pair->flicker(), 0);
  EXPECT_GT(*pair->truth_change(), 0.1);
}

/// Frame n of a surface that is `motion` further each frame back, with an error.
SequenceFramePlanes rigid_frame(int n, const Values& error_on_screen, const Values& error_on_surface) {
  constexpr int dx = -3, dy = 2;
  const auto on_surface = [n](const Values& values) {
    return [n, values](int x, int y) { return values(x + n * dx, y + n * dy); };
  };
  const Values truth = on_surface(texture), carried = on_surface(error_on_surface);
  SequenceFramePlanes frame =
      frame_with([=](int x, int y) { return truth(x, y) + error_on_screen(x, y) + carried(x, y); }, truth);
  frame.surfaces.motion = motion_with(constant(dx), constant(dy));
  return frame;
}

std::optional<FlickerSums> rigid_pair(const Values& error_on_screen, const Values& error_on_surface) {
  FlickerMeter meter;
  meter.add(rigid_frame(0, error_on_screen, error_on_surface));
  std::optional<FlickerSums> pair = meter.add(rigid_frame(1, error_on_screen, error_on_surface));
  EXPECT_EQ(meter.source(), MotionSource::plane);
  return pair;
}

TEST(Flicker, OfAnErrorThatStaysOnItsSurfaceIsNone) {
  const std::optional<FlickerSums> pair = rigid_pair(constant(0), [](int x, int y) { return 0.1f * texture(y, x); });
  EXPECT_NEAR(*pair->flicker(), 0, 1e-7);
  EXPECT_NEAR(*pair->truth_change(), 0, 1e-7);
  EXPECT_EQ(pair->pixels, all_pixels);
  EXPECT_EQ(pair->comparable, (width - 3) * (height - 2)) << "the rest was outside the image";
}

TEST(Flicker, OfAnErrorThatStaysOnTheScreenIsItsChangeAlongMotion) {
  const std::optional<FlickerSums> pair = rigid_pair([](int x, int) { return 0.01f * float(x); }, constant(0));
  EXPECT_NEAR(*pair->flicker(), 0.03, 1e-7) << "a ramp of 0.01 per pixel, and 3 pixels";
}

TEST(Flicker, ReadsBetweenPixels) {
  FlickerMeter meter;
  for (int n = 0; n < 2; ++n) {
    SequenceFramePlanes frame =
        frame_with([](int x, int y) { return 0.01f * float(x) + 0.02f * float(y); }, constant(0));
    frame.surfaces.motion = motion_with(constant(0.25f), constant(-0.75f));
    for (size_t i = 0; n && i < frame.foreground.size(); ++i)  // all four pixels are inside
      frame.foreground[i] = i >= size_t(width) && i % size_t(width) < size_t(width) - 1;
    const std::optional<FlickerSums> pair = meter.add(std::move(frame));
    if (!n) continue;
    EXPECT_NEAR(*pair->flicker(), 0.02 * 0.75 - 0.01 * 0.25, 1e-7);
    EXPECT_EQ(pair->comparable, (width - 1) * (height - 1));
  }
}

Camera camera_at(double x) {
  Camera camera;
  camera.fx = camera.fy = 20;
  camera.cx = width / 2.0, camera.cy = height / 2.0;
  camera.pose = Pose{glm::dmat3(1), {x, 0, 0}};
  return camera;
}

TEST(Flicker, FollowsCamerasAndDepth) {
  FlickerMeter meter;
  for (int n = 0; n < 2; ++n) {
    // a wall at 5: a step of 0.5 is 2 pixels
    SequenceFramePlanes frame = frame_with([](int x, int) { return 0.01f * float(x); }, constant(0));
    frame.surfaces.camera = camera_at(0.5 * n);
    frame.surfaces.depth = channel_with(constant(5));
    const std::optional<FlickerSums> pair = meter.add(std::move(frame));
    if (!n) continue;
    EXPECT_EQ(meter.source(), MotionSource::cameras);
    EXPECT_NEAR(*pair->flicker(), 0.02, 1e-6);
    EXPECT_EQ(pair->comparable, (width - 2) * height);
  }
}

TEST(Flicker, ExpectsTheDepthThatTheCameraBeforeSaw) {
  FlickerMeter meter;
  for (int n = 0; n < 2; ++n) {
    SequenceFramePlanes frame = frame_with(constant(0.5f), constant(0.5f));
    frame.surfaces.camera = camera_at(0);
    frame.surfaces.camera->pose->position.z = -2.0 * n;  // ahead
    frame.surfaces.depth = channel_with(constant(n ? 3 : 5));
    const std::optional<FlickerSums> pair = meter.add(std::move(frame));
    if (n) {
      EXPECT_EQ(pair->comparable, all_pixels) << "a wall that comes nearer stays in view";
    }
  }
}

/// A box at 2 before a wall at 10, which moves 4 columns to the right between frames 0 and 1 and stands still then.
SequenceFramePlanes box_frame(int n, float error_where_uncovered) {
  const int left = n ? 14 : 10;
  const auto is_box = [left](int x) { return x >= left && x < left + 6; };
  const auto error = [=](int x, int) { return n && x >= 10 && x < 14 ? error_where_uncovered : 0; };
  SequenceFramePlanes frame = frame_with(error, constant(0));
  frame.surfaces.depth = channel_with([=](int x, int) { return is_box(x) ? 2.f : 10.f; });
  frame.surfaces.motion = motion_with([=](int x, int) { return n == 1 && is_box(x) ? -4.f : 0.f; }, constant(0));
  return frame;
}

TEST(Flicker, LeavesOutWhatComesIntoViewAndTellsItsErrorForEightFrames) {
  FlickerMeter meter;
  meter.add(box_frame(0, 0.5f));
  for (int n = 1; n <= FlickerMeter::young + 1; ++n) {
    const std::optional<FlickerSums> pair = meter.add(box_frame(n, 0.5f));
    EXPECT_EQ(pair->comparable, n == 1 ? (width - 4) * height : all_pixels) << n;
    EXPECT_EQ(pair->flicker(), 0) << n;
    const bool is_new = n <= FlickerMeter::young;
    EXPECT_EQ(pair->new_values, is_new ? 4 * height : 0) << n;
    EXPECT_EQ(pair->old_rmse().value() == 0, is_new) << n;
    if (is_new) {
      EXPECT_EQ(pair->new_rmse(), 0.5) << n;
    }
  }
}

TEST(Flicker, KnowsNothingOfWhatComesBeforeAGap) {
  FlickerMeter meter;
  meter.add(box_frame(0, 0.5f));
  meter.begin_anew();
  EXPECT_FALSE(meter.add(box_frame(1, 0.5f)));
  EXPECT_EQ(meter.add(box_frame(2, 0.5f))->new_values, 0);
}

TEST(Flicker, KnowsASlantedSurfaceAgain) {
  FlickerMeter meter;
  for (int n = 0; n < 2; ++n) {
    // a floor whose depth changes by a sixth from the first row to the second, half a row further in each frame
    SequenceFramePlanes frame = frame_with(constant(0.5f), constant(0.5f));
    frame.surfaces.depth = channel_with([n](int, int y) { return 1 / (0.05f + 0.01f * (float(y) + 0.5f * float(n))); });
    frame.surfaces.motion = motion_with(constant(0), constant(0.5f));
    const std::optional<FlickerSums> pair = meter.add(std::move(frame));
    if (n) {
      EXPECT_GE(pair->comparable, width * (height - 1));
    }
  }
}

TEST(Flicker, ReadsNoBackgroundOfTheFrameBefore) {
  FlickerMeter meter;
  for (int n = 0; n < 2; ++n) {
    SequenceFramePlanes frame = frame_with(
        [n](int x, int) { return x < 4 && !n ? std::numeric_limits<float>::quiet_NaN() : 0.5f; }, constant(0.5f));
    if (!n) {
      for (size_t i = 0; i < frame.foreground.size(); ++i) frame.foreground[i] = i % size_t(width) >= 4;
    }
    const std::optional<FlickerSums> pair = meter.add(std::move(frame));
    if (!n) continue;
    EXPECT_EQ(pair->flicker(), 0);
    EXPECT_EQ(pair->comparable, (width - 4) * height);
  }
}

TEST(Flicker, RefusesFramesOfAnotherSize) {
  FlickerMeter meter;
  meter.add(frame_with(constant(0), constant(0)));
  SequenceFramePlanes narrow = frame_with(constant(0), constant(0));
  narrow.truth = ao_with(constant(0), width - 1);
  EXPECT_NE(message_of([&] { meter.add(std::move(narrow)); }).find("23x16, and the sequence is 24x16"),
            std::string::npos);
  SequenceFramePlanes flat = frame_with(constant(0), constant(0));
  flat.surfaces.motion = ao_with(constant(0));
  EXPECT_NE(message_of([&] { meter.add(std::move(flat)); }).find("1 components instead of x and y"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::flicker_test
