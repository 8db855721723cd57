// Ambient occlusion as a mean over frames (kernels/temporal), through plans and runs.
#include <gtest/gtest.h>

#include "gloam/history.h"
#include "gloam/plan.h"
#include "gloam/run.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::temporal_test {
namespace {

constexpr int width = 96, height = 64;

/// A floor and a wall, and perhaps a block on the floor, whose left side is at x; the eye stands at `eye`.
struct Room {
  std::optional<double> block;
  double eye = 0;
};

/// The frame of a room, with the poses of its eye.
Frame frame_of(const Room& room, int columns = width, int rows = height) {
  const Shot shot = perspective(columns, rows);
  const auto moved = [&](const Scene& scene) -> Scene {
    return [scene, eye = room.eye](const EyeRay& ray) {
      return scene({ray.origin + glm::dvec3(eye, 0, 0), ray.direction});
    };
  };
  std::vector<Scene> scenes = {corner()};
  if (room.block) {
    const double left = *room.block;
    scenes.push_back([left](const EyeRay& ray) -> std::optional<Surface> {
      const double depth = 3.2;
      const glm::dvec3 p = ray.origin + depth * ray.direction;
      if (p.x < left || p.x > left + 0.8 || p.y < -1 || p.y > 0.4) return {};
      return Surface{depth, {0, 0, 1}};
    });
  }
  Frame frame = shoot(shot, moved(nearest_of(scenes)));
  frame.views[0].camera->pose = Pose();
  frame.views[0].camera->pose->position.x = room.eye;
  return frame;
}

/// gtao of the frames of a sequence, each with other samples; the last one's planes.
class Sequence {
 public:
  explicit Sequence(std::vector<std::pair<std::string, std::string>> settings = {}, RunOptions options = {})
      : settings_(std::move(settings)), options_(options) {}

  const Frame& add(Frame frame) {
    PlanRequest request{.outputs = {"gtao"}, .preset = "low", .settings = settings_, .temporal = true};
    request.settings.emplace_back("radius", "0.5");
    if (before_)
      add_history(frame, std::move(*before_), history_planes(), "the frame before");
    else
      add_no_history(frame, history_planes());
    const Plan plan = make_plan(request, plane_names(frame), "the frame has not");
    ++options_.seed;
    result_ = run(plan, frame, device(), options_).frame;
    before_.emplace();
    before_->window = frame.window;
    before_->display = frame.display;
    View& kept = before_->views.emplace_back();
    kept.camera = frame.views[0].camera;
    for (const char* plane : {"ao_raw", "frames"}) kept.planes[plane] = result_.views[0].find(plane)->clone();
    kept.planes["depth"] = frame.views[0].find("depth")->clone();
    return result_;
  }
  const Channel& last(const std::string& plane) const { return result_.views[0].find(plane)->channels[0]; }

 private:
  std::vector<std::pair<std::string, std::string>> settings_;
  RunOptions options_;
  std::optional<Frame> before_;
  Frame result_;
};

/// Root mean square of the difference over columns `from` to `to` of the lower half, the floor.
double difference(const Channel& a, const Channel& b, int from = 8, int to = width - 8) {
  double sum = 0;
  int count = 0;
  for (int y = height / 2 + 4; y < height - 4; ++y) {
    for (int x = from; x < to; ++x, ++count) sum += std::pow(double(a.at(x, y)) - double(b.at(x, y)), 2);
  }
  return std::sqrt(sum / count);
}

/// The same estimator with many seeds: what a sequence at rest converges to.
const Channel& converged() {
  static Sequence sequence;
  static const bool done = [] {
    for (int i = 0; i < 60; ++i) sequence.add(frame_of({}));
    return true;
  }();
  (void)done;
  return sequence.last("ao_raw");
}

TEST(Temporal, AStandingEyeConverges) {
  Sequence sequence({}, {.seed = 1000});
  sequence.add(frame_of({}));
  const double alone = difference(sequence.last("ao_raw"), converged());
  EXPECT_EQ(sequence.last("frames").at(20, 40), 1);
  for (int i = 1; i < 16; ++i) sequence.add(frame_of({}));
  EXPECT_NEAR(sequence.last("frames").at(20, 40), 16, 1e-3);
  const double after = difference(sequence.last("ao_raw"), converged());
  std::printf("RMSE to the converged mean: 1 frame %.4f, 16 frames %.4f\n", alone, after);
  // White noise would fall to a fourth; the samples of successive frames are spread better than that.
  EXPECT_LT(after, alone / 4);
  EXPECT_GT(alone, 0.02) << "there is noise to begin with";
}

TEST(Temporal, AMovingEyeGoesOnFromTheSameSurfaces) {
  Sequence sequence({}, {.seed = 1000});
  // 0.013 units a frame: about half a pixel on the floor.
  for (int i = 0; i < 12; ++i) sequence.add(frame_of({.eye = 0.013 * (i - 11)}));
  Sequence one({}, {.seed = 1011});
  one.add(frame_of({}));
  EXPECT_LT(difference(sequence.last("ao_raw"), converged()), 0.5 * difference(one.last("ao_raw"), converged()));
  EXPECT_GT(sequence.last("frames").at(40, 50), 8);
  // What comes into the image by a third of a pixel a frame stays nearly new: N = 1 + 2/3 N.
  EXPECT_LT(sequence.last("frames").at(width - 1, 50), 3.5);
}

TEST(Temporal, WhatABlockCoveredOrDarkenedIsForgottenAsItGoes) {
  const auto after = [](int frames, const std::vector<std::pair<std::string, std::string>>& settings) {
    Sequence sequence(settings, {.seed = 1000});
    for (int i = 0; i < 20; ++i) sequence.add(frame_of({.block = -0.4}));
    for (int i = 0; i < frames; ++i) sequence.add(frame_of({}));
    // Columns that the block covered, and those beside, which it darkened.
    return difference(sequence.last("ao"), converged(), 24, 72);
  };
  Sequence one({}, {.seed = 1022});
  one.add(frame_of({}));
  const double alone = difference(one.last("ao"), converged(), 24, 72);
  const double kept = after(3, {{"temporal.change_tolerance", "inf"}}), forgotten = after(3, {});
  std::printf("RMSE 3 frames after a block has gone: alone %.4f, tested %.4f, untested %.4f\n", alone, forgotten, kept);
  EXPECT_LT(forgotten, 1.3 * alone);
  EXPECT_GT(kept, 1.5 * forgotten) << "the test has something to forget";
}

TEST(Temporal, MotionOfASurfaceIsFollowed) {
  Sequence sequence({}, {.seed = 1000});
  // The block moves by 2 pixels a frame: 3.2 * 2 * tan(30 degrees) / 96 units each.
  const double step = 2 * 3.2 * 2 * std::tan(M_PI / 6) / width;
  Frame frame;
  for (int i = 0; i < 8; ++i) {
    frame = frame_of({.block = -0.6 + step * i});
    Plane& motion = plane_of(frame, "motion");
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool is_block = std::abs(frame.views[0].find("depth")->channels[0].at(x, y) - 3.2f) < 1e-4f;
        motion.channels[0].at(x, y) = is_block ? -2 : 0;
        motion.channels[1].at(x, y) = 0;
      }
    }
    sequence.add(std::move(frame));
  }
  const Frame last = frame_of({.block = -0.6 + step * 7});
  int block = 0, old = 0;
  for (int x = 0; x < width; ++x) {
    if (std::abs(last.views[0].find("depth")->channels[0].at(x, 40) - 3.2f) > 1e-4f) continue;
    ++block;
    old += sequence.last("frames").at(x, 40) > 4;
  }
  EXPECT_GT(block, 10);
  EXPECT_GE(old, block - 4) << "its borders are new";
}

TEST(Temporal, AnInfiniteRadiusForgetsNothingAtRest) {
  Sequence sequence({{"temporal.radius", "inf"}}, {.seed = 1});
  for (int i = 0; i < 8; ++i) sequence.add(frame_of({}));
  for (int x = 8; x < width - 8; ++x) ASSERT_NEAR(sequence.last("frames").at(x, 50), 8, 1e-3) << x;
}

TEST(Temporal, IsTheSameAtEveryLaneWidth) {
  std::vector<Frame> results;
  for (const int lanes : {1, 4, 8, 16}) {
    Sequence sequence({}, {.math = Math::precise, .lanes = lanes, .seed = 7});
    for (int i = 0; i < 3; ++i)
      sequence.add(frame_of({.block = i == 2 ? std::nullopt : std::optional(-0.4), .eye = 0.02 * i}, 45, 31));
    results.push_back(Frame());
    for (const char* plane : {"ao_raw", "frames"}) {
      results.back().views.resize(1);
      Plane copy{plane, {}};
      copy.channels.push_back(sequence.last(plane).clone());
      results.back().views[0].planes[plane] = std::move(copy);
    }
  }
  for (size_t i = 1; i < results.size(); ++i) {
    for (const char* plane : {"ao_raw", "frames"}) {
      const Channel &a = results[0].views[0].find(plane)->channels[0],
                    &b = results[i].views[0].find(plane)->channels[0];
      for (int y = 0; y < 31; ++y) {
        for (int x = 0; x < 45; ++x) ASSERT_EQ(a.at(x, y), b.at(x, y)) << plane << " " << x << " " << y;
      }
    }
  }
}

TEST(Temporal, OnlyPlansThatMakeAoOrReflectionsGoOn) {
  const Frame frame = frame_of({});
  const auto planned = [&](PlanRequest request) {
    request.temporal = true;
    std::vector<std::string> names = plane_names(frame);
    names.insert(names.end(), history_planes().begin(), history_planes().end());
    return make_plan(request, names, "the frame has not");
  };
  EXPECT_THROW(planned({.outputs = {"normals"}}), UsageError);
  EXPECT_THROW(planned({.outputs = {"gtao"}, .resolution = 2}), UsageError);
  EXPECT_THROW(planned({.outputs = {"gtao"}, .adaptive = "low"}), UsageError);
  // The filter's, in radii: accumulation has no parameter of this name.
  EXPECT_NO_THROW(planned({.outputs = {"gtao"}, .settings = {{"depth_tolerance", "2"}}}));
  const auto radius_of_accumulation = [&](const Settings& settings) {
    for (const PlannedPass& pass : planned({.outputs = {"gtao"}, .settings = settings}).passes) {
      if (pass.label() == "temporal/accumulate") return pass.values.text("radius");
    }
    return std::string();
  };
  EXPECT_EQ(radius_of_accumulation({{"gtao.radius", "2"}}), "2");
  EXPECT_EQ(radius_of_accumulation({{"radius", "2"}, {"temporal.radius", "3"}}), "3");
  const auto outputs_for = [&](const std::vector<std::string>& only) {
    return planned({.outputs = {"gtao"}, .only_outputs = only}).outputs;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(outputs_for({"ao", "ao_raw"}), (Names{"ao", "ao_raw", "frames"})) << "a history needs both";
  EXPECT_EQ(outputs_for({"ao"}), (Names{"ao"}));
  EXPECT_EQ(outputs_for({"ao", "frames"}), (Names{"ao", "frames"}));
  EXPECT_EQ(outputs_for({}), (Names{"ao", "ao_raw", "frames"}));
}

}  // namespace
}  // namespace gloam::test::temporal_test
