// Screen-space reflections against the exact image in a mirror, solved for in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "gloam/exr.h"
#include "gloam/metrics.h"
#include "gloam/planes.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/reflection_reference.h"
#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test::reflection_test {
namespace {

using glm::dvec3;

constexpr double floor_height = -1, wall_distance = 5, down = 0.4;

dvec3 turned(const dvec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

/// Squares of 0.5 on the wall, in two colours that differ in all components.
dvec3 checker(const dvec3& p) {
  const bool odd = (int(std::floor(p.x / 0.5)) + int(std::floor(p.y / 0.5))) & 1;
  return odd ? dvec3(0.9, 0.2, 0.4) : dvec3(0.1, 0.7, 0.3);
}

/// Distance to the nearest edge of a square.
double from_edge(const dvec3& p) {
  const auto off = [](double v) { return std::abs(v / 0.5 - std::round(v / 0.5)) * 0.5; };
  return std::min(off(p.x), off(p.y));
}

/// A post before the wall, as a box of the room's space.
struct Post {
  double low_x = 0, high_x = -1, near_z = -3, far_z = -3.2, bottom = -10,
         top = 0.6;  ///< no post if high_x is below low_x

  /// Multiples of d from o at which the ray enters and leaves the post; infinite if it misses.
  std::pair<double, double> crossing(const dvec3& o, const dvec3& d) const {
    double in = 0, out = std::numeric_limits<double>::infinity();
    const dvec3 low(low_x, bottom, far_z), high(high_x, top, near_z);
    for (int i = 0; i < 3; ++i) {
      const double a = (low[i] - o[i]) / d[i], b = (high[i] - o[i]) / d[i];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return high_x < low_x || !(in < out) ? std::pair(infinity, infinity) : std::pair(in, out);
  }
};

/// A room without side walls: a mirror as floor, a checker wall at its end, perhaps a post, seen by an eye that looks down.
struct MirrorRoom {
  Shot shot;
  dvec3 eye;
  Post post;
  Frame frame;

  explicit MirrorRoom(const Shot& shot_, double eye_x = 0, const Post& post_ = {})
      : shot(shot_), eye(eye_x, 0, 0), post(post_) {
    const Scene scene = [this](const EyeRay& ray) -> std::optional<Surface> {
      const dvec3 o = turned(ray.origin, -down) + eye, d = turned(ray.direction, -down);
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const double to_floor = d.y < 0 ? (floor_height - o.y) / d.y : infinity;
      const double to_wall = d.z < 0 ? (-wall_distance - o.z) / d.z : infinity;
      const double to_post = post.crossing(o, d).first;
      const double first = std::min({to_floor, to_wall, to_post});
      if (!std::isfinite(first)) return {};
      if (first == to_post) return Surface{to_post, turned(post_normal(o + to_post * d), down)};
      return Surface{first, turned(first == to_floor ? dvec3(0, 1, 0) : dvec3(0, 0, 1), down)};
    };
    frame = shoot(shot, scene);
    for (const char* name : {"color", "roughness", "reflectance", "back_depth", "instance"}) plane_of(frame, name);
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) paint(x, y);
    }
    Pose pose;
    pose.position = eye;
    for (int i = 0; i < 3; ++i) {
      dvec3 axis(0);
      axis[i] = 1;
      pose.world_to_view[i] = turned(axis, down);
    }
    frame.views[0].camera->pose = pose;
  }

  void paint(int x, int y) {
    const dvec3 p = point(x, y);
    const bool is_mirror = is_floor(x, y);
    const dvec3 color = is_mirror ? dvec3(0) : is_post(p) ? dvec3(0.5, 0.5, 0) : checker(p);
    for (size_t i = 0; i < 3; ++i) {
      plane_of(frame, "color").channels[i].at(x, y) = float(color[int(i)]);
      plane_of(frame, "reflectance").channels[i].at(x, y) = is_mirror ? 1 : 0;
    }
    plane_of(frame, "roughness").channels[0].at(x, y) = 0;
    plane_of(frame, "instance").channels[0].at(x, y) = is_mirror ? 1 : is_post(p) ? 2 : 3;
    if (!is_post(p)) return;
    const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
    plane_of(frame, "back_depth").channels[0].at(x, y) =
        float(post.crossing(turned(ray.origin, -down) + eye, turned(ray.direction, -down)).second);
  }

  dvec3 post_normal(const dvec3& p) const {
    if (std::abs(p.x - post.low_x) < 1e-9) return {-1, 0, 0};
    if (std::abs(p.x - post.high_x) < 1e-9) return {1, 0, 0};
    if (std::abs(p.y - post.bottom) < 1e-9) return {0, -1, 0};
    return std::abs(p.y - post.top) < 1e-9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  }
  bool is_post(const dvec3& p) const {
    return p.x > post.low_x - 1e-4 && p.x < post.high_x + 1e-4 && p.z > post.far_z - 1e-4 &&
           p.y > std::max(floor_height, post.bottom) - 1e-4 && p.y > floor_height + 1e-4;
  }

  /// In the room's own space, where the floor is level.
  dvec3 point(int x, int y) const {
    const EyeRay ray = ray_through(shot, x + 0.5, y + 0.5);
    const double depth = frame.views[0].find("depth")->channels[0].at(x, y);
    return turned(ray.origin + depth * ray.direction, -down) + eye;
  }
  bool is_floor(int x, int y) const { return point(x, y).y < floor_height + 1e-4; }

  /// The point of the wall to which the mirror sends the eye's ray. `meets_post`: the ray does not get there.
  dvec3 reflected(int x, int y, bool* meets_post = nullptr) const {
    dvec3 d = turned(ray_through(shot, x + 0.5, y + 0.5).direction, -down);
    d.y = -d.y;
    const dvec3 p = point(x, y);
    if (meets_post) *meets_post = std::isfinite(post.crossing(p, d).first);
    return p + d * ((-wall_distance - p.z) / d.z);
  }

  /// The pixel of a point.
  glm::dvec2 projected(const dvec3& room) const {
    const dvec3 p = turned(room - eye, down);
    const double lateral = shot.camera.orthographic ? 1 : -p.z;
    return {shot.camera.cx + shot.camera.fx * p.x / lateral, shot.camera.cy - shot.camera.fy * p.y / lateral};
  }

  bool shows(const dvec3& room, double margin) const {
    const glm::dvec2 p = projected(room);
    return p.x > margin && p.y > margin && p.x < shot.width - margin && p.y < shot.height - margin;
  }
};

const Settings plain = {{"fade_border", "0"}, {"environment_r", "5"}};

std::vector<Shot> shots() { return {perspective(160, 120, 70), orthographic(160, 120, 5)}; }

TEST(Reflection, MirrorFloorShowsTheCheckerWall) {
  for (const Shot& shot : shots()) {
    MirrorRoom room(shot);
    const Frame out = outputs_of(find_technique("sssr"), room.frame, plain, {.math = Math::precise});
    const std::vector<Channel>& reflection = out.views[0].find("reflection")->channels;
    const Channel& hit = out.views[0].find("hit")->channels[0];
    int compared = 0, missed = 0;
    double worst = 0, worst_length = 0;
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        if (!room.is_floor(x, y)) continue;
        const dvec3 met = room.reflected(x, y);
        if (!room.shows(met, -0.5)) {
          // Nothing can be met beyond the image: the environment.
          ++missed;
          EXPECT_EQ(reflection[3].at(x, y), 0) << x << ", " << y;
          EXPECT_NEAR(reflection[0].at(x, y), 5, 1e-5) << x << ", " << y;
          EXPECT_EQ(hit.at(x, y), 0) << x << ", " << y;
          continue;
        }
        // Within two pixels of an edge, colours are a mean of both sides.
        if (!room.shows(met, 1) || from_edge(met) < 0.09) continue;
        ++compared;
        EXPECT_NEAR(reflection[3].at(x, y), 1, 1e-6) << x << ", " << y;
        for (size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(reflection[i].at(x, y) - checker(met)[int(i)]));
        const double length = glm::distance(met, room.point(x, y));
        worst_length = std::max(worst_length, std::abs(hit.at(x, y) - length) / length);
      }
    }
    std::printf("compared %d pixels, %d without a hit: worst color %.1e, worst length %.1e\n", compared, missed, worst,
                worst_length);
    EXPECT_GT(compared, 1000);
    EXPECT_GT(missed, 50);
    EXPECT_LT(worst, 1e-5);
    EXPECT_LT(worst_length, 1e-3);
  }
}

// Each pixel has the value it has with all steps, or the environment: never something that its ray has not reached.
TEST(Reflection, RayWithoutStepsLeftIsAMiss) {
  for (const Shot& shot : shots()) {
    MirrorRoom room(shot);
    const Technique& sssr = find_technique("sssr");
    const Frame all = outputs_of(sssr, room.frame, plain, {.math = Math::precise});
    long long before = -1;
    for (const char* steps : {"1", "4", "8", "16", "32"}) {
      Settings settings = plain;
      settings.emplace_back("max_steps", steps);
      const Frame some = outputs_of(sssr, room.frame, settings, {.math = Math::precise});
      long long found = 0, missed = 0;
      for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
          if (!room.is_floor(x, y)) continue;
          const float confidence = some.views[0].find("reflection")->channels[3].at(x, y);
          const float red = some.views[0].find("reflection")->channels[0].at(x, y);
          if (confidence == 0) {
            ++missed;
            EXPECT_NEAR(red, 5, 1e-5);
          } else {
            ++found;
            EXPECT_EQ(red, all.views[0].find("reflection")->channels[0].at(x, y)) << x << ", " << y;
          }
        }
      }
      EXPECT_GT(missed, 0) << steps;
      EXPECT_GE(found, before) << steps;
      before = found;
    }
    EXPECT_GT(before, 100);
  }
}

// Cells skip only pixels that would not have been met.
TEST(Reflection, HierarchyFindsWhatPixelsFind) {
  for (const Shot& shot : {perspective(157, 101, 70), orthographic(157, 101, 4)}) {
    Frame frame = shoot(shot, room());
    const Technique& sssr = find_technique("sssr");
    Settings settings = {{"neighbours", "1"}, {"max_roughness", "1"}, {"march", "linear"}};
    const Frame linear = outputs_of(sssr, frame, settings, {.math = Math::precise});
    settings.back() = {"cells", "min"};
    const Frame nearest = outputs_of(sssr, frame, settings, {.math = Math::precise});
    settings.back() = {"cells", "min_max"};
    const Frame both = outputs_of(sssr, frame, settings, {.math = Math::precise});
    EXPECT_TRUE(same_bits(nearest, both));
    int other = 0, hits = 0;
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const float a = linear.views[0].find("hit")->channels[0].at(x, y);
        const float b = both.views[0].find("hit")->channels[0].at(x, y);
        hits += a > 0;
        other += std::abs(a - b) > 1e-3f * (a + b);
      }
    }
    std::printf("%d of %d hits differ\n", other, hits);
    EXPECT_GT(hits, 2000);
    EXPECT_LE(other, hits / 500);  // rounding of where a ray enters a pixel
  }
}

// Each pixel's rays are followed, whatever their number and the number of pixels of a work-item.
TEST(Reflection, ManyRaysGiveTheSameBitsAtEveryLaneWidth) {
  Frame frame = shoot(perspective(93, 61, 70), gloam::test::room());
  const Technique& sssr = find_technique("sssr");
  const Settings settings = {{"rays", "4"}};
  const Frame one = outputs_of(sssr, frame, settings, {.math = Math::precise, .lanes = 1});
  EXPECT_TRUE(same_bits(one, outputs_of(sssr, frame, settings, {.math = Math::precise, .lanes = 1})));
  EXPECT_TRUE(same_bits(one, outputs_of(sssr, frame, settings, {.math = Math::precise, .lanes = 16})));
}

// With one lane, as on GPUs, a work-item follows several rays where there are many.
TEST(Reflection, WorkItemsThatShareRaysLoseNone) {
  Frame frame = shoot(perspective(960, 540, 70), gloam::test::room());
  const Technique& sssr = find_technique("sssr");
  const Frame one = outputs_of(sssr, frame, {}, {.math = Math::precise, .lanes = 1});
  EXPECT_TRUE(same_bits(one, outputs_of(sssr, frame, {}, {.math = Math::precise, .lanes = 16})));
}

// --- Two eyes

Frame pair_of(const MirrorRoom& left, const MirrorRoom& right) {
  Frame pair = clone(left.frame);
  Frame second = clone(right.frame);
  pair.views[0].name = "left";
  second.views[0].name = "right";
  pair.views.push_back(std::move(second.views[0]));
  for (View& view : pair.views) view.camera->pose = (view.name == "left" ? left : right).frame.views[0].camera->pose;
  return pair;
}

const Channel& confidence(const Frame& frame, size_t view) {
  return frame.views.at(view).find("reflection")->channels[3];
}

/// How often the wall that a pixel's mirror ray reaches was found, out of `asked`.
struct Found {
  int asked = 0, found = 0, wrong = 0;
};

template <typename Asked>
Found found_on_wall(const MirrorRoom& room, const Frame& out, size_t view, const Asked& is_asked) {
  Found f;
  for (int y = 0; y < room.shot.height; ++y) {
    for (int x = 0; x < room.shot.width; ++x) {
      bool meets_post = false;
      if (!room.is_floor(x, y)) continue;
      const dvec3 met = room.reflected(x, y, &meets_post);
      if (meets_post || from_edge(met) < 0.1 || !is_asked(met)) continue;
      ++f.asked;
      if (confidence(out, view).at(x, y) < 0.99f) continue;
      double off = 0;
      for (size_t i = 0; i < 3; ++i) {
        const double red = out.views[view].find("reflection")->channels[i].at(x, y);
        off = std::max(off, std::abs(red - checker(met)[int(i)]));
      }
      ++(off < 1e-4 ? f.found : f.wrong);
    }
  }
  return f;
}

/// The reflections of both eyes, through one image or both.
Frame traversed(Frame& pair, const char* traversal) {
  return outputs_of(find_technique("stereo-ssr"), pair, {{"fade_border", "0"}, {"traversal", traversal}},
                    {.math = Math::precise});
}

// Objects beyond the border of one image are found in the other's.
TEST(StereoReflection, GoesOnInTheOtherEyeBeyondTheBorder) {
  const Shot shot = perspective(160, 120, 70);
  const MirrorRoom left(shot, -0.2), right(shot, 0.2);
  Frame pair = pair_of(left, right);
  const Frame both = traversed(pair, "stereo"), mono = traversed(pair, "mono");
  const auto only_right = [&](const dvec3& met) { return !left.shows(met, -1) && right.shows(met, 1); };
  const auto only_left = [&](const dvec3& met) { return !right.shows(met, -1) && left.shows(met, 1); };
  for (const size_t view : {0, 1}) {
    const MirrorRoom& own = view == 0 ? left : right;
    const Found with = view == 0 ? found_on_wall(own, both, 0, only_right) : found_on_wall(own, both, 1, only_left);
    const Found without = view == 0 ? found_on_wall(own, mono, 0, only_right) : found_on_wall(own, mono, 1, only_left);
    std::printf("view %zu: %d of %d found in the other, %d by itself\n", view, with.found, with.asked, without.found);
    EXPECT_GT(with.asked, 50);
    EXPECT_EQ(with.found, with.asked);
    EXPECT_EQ(without.found + without.wrong, 0);
  }
}

// As in one image: rays that go on in the other eye are followed by work-items that share a list too.
TEST(StereoReflection, WorkItemsThatShareRaysLoseNone) {
  const Shot shot = perspective(960, 540, 70);
  Frame pair = pair_of(MirrorRoom(shot, -0.2), MirrorRoom(shot, 0.2));
  const Technique& stereo = find_technique("stereo-ssr");
  const Settings settings = {{"rays", "2"}};
  const Frame one = outputs_of(stereo, pair, settings, {.math = Math::precise, .lanes = 1});
  EXPECT_TRUE(same_bits(one, outputs_of(stereo, pair, settings, {.math = Math::precise, .lanes = 16})));
}

// The wall behind a post, where the other eye sees it.
TEST(StereoReflection, GoesOnInTheOtherEyeBehindThings) {
  const Shot shot = perspective(240, 180, 70);
  const Post post{.low_x = -0.1, .high_x = 0.1, .bottom = -0.35};  // rays from the mirror pass under it
  const MirrorRoom left(shot, -0.25, post), right(shot, 0.25, post);
  Frame pair = pair_of(left, right);
  const Frame both = traversed(pair, "stereo"), mono = traversed(pair, "mono");
  const auto hidden_from = [&](const MirrorRoom& room, const dvec3& met) {
    return std::isfinite(post.crossing(room.eye, met - room.eye).first);
  };
  const auto asked = [&](const dvec3& met) {
    return left.shows(met, 1) && right.shows(met, 1) && hidden_from(left, met) && !hidden_from(right, met);
  };
  const Found with = found_on_wall(left, both, 0, asked), without = found_on_wall(left, mono, 0, asked);
  std::printf("%d of %d found behind the post and %d wrong; without the other eye %d and %d\n", with.found, with.asked,
              with.wrong, without.found, without.wrong);
  EXPECT_GT(with.asked, 30);
  // The other rays are behind the post for the other eye too when they pass behind it for this one.
  EXPECT_GT(3 * with.found, 2 * with.asked);
  EXPECT_EQ(with.wrong, 0);
  EXPECT_LT(without.found, 0.05 * with.asked);  // at the post's very edge
}

// However large the cells are that hide a ray, the other eye follows it from where it passed behind them.
TEST(StereoReflection, LargeCellsHideNothingFromTheOtherEye) {
  const Shot shot = perspective(240, 180, 70);
  const Post post{.low_x = -0.5, .high_x = 0.3, .bottom = -0.35};
  Frame pair = pair_of(MirrorRoom(shot, -0.3, post), MirrorRoom(shot, 0.3, post));
  const Technique& stereo = find_technique("stereo-ssr");
  const Frame both = outputs_of(stereo, pair, {{"fade_border", "0"}, {"cells", "min_max"}}, {.math = Math::precise}),
              pixels = outputs_of(stereo, pair, {{"fade_border", "0"}, {"march", "linear"}}, {.math = Math::precise});
  int found = 0, lost = 0;
  for (const size_t view : {0, 1}) {
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        found += confidence(pixels, view).at(x, y) > 0.5f;
        lost += confidence(pixels, view).at(x, y) > 0.5f && confidence(both, view).at(x, y) < 0.5f;
      }
    }
  }
  std::printf("%d of %d hits are lost by large cells\n", lost, found);
  EXPECT_GT(found, 5000);
  EXPECT_LT(lost, found / 200);
}

TEST(StereoReflection, SwappingTheEyesSwapsTheImages) {
  const Shot shot = perspective(96, 64, 70);
  const Post post{.low_x = -0.3, .high_x = 0.1};
  Frame pair = pair_of(MirrorRoom(shot, -0.1, post), MirrorRoom(shot, 0.1, post));
  for (View& view : pair.views) {
    for (const char* name : {"roughness", "reflectance"}) {
      for (Channel& channel : view.planes.at(name).channels) {
        for (int y = 0; y < shot.height; ++y)
          for (int x = 0; x < shot.width; ++x) channel.at(x, y) = 0.4f;
      }
    }
  }
  Frame other = clone(pair);
  std::swap(other.views[0], other.views[1]);
  const Technique& stereo = find_technique("stereo-ssr");
  const Frame a = outputs_of(stereo, pair, {}, {.math = Math::precise}),
              b = outputs_of(stereo, other, {}, {.math = Math::precise});
  for (const char* plane : {"reflection", "hit"}) {
    EXPECT_EQ(difference(*a.views[0].find(plane), *b.views[1].find(plane)).max, 0) << plane;
    EXPECT_EQ(difference(*a.views[1].find(plane), *b.views[0].find(plane)).max, 0) << plane;
  }
}

TEST(StereoReflection, WithoutItsModulesItIsThePlainOne) {
  const Shot shot = perspective(96, 64, 70);
  Frame pair = pair_of(MirrorRoom(shot, -0.1, Post{.low_x = -0.3, .high_x = 0.1}), MirrorRoom(shot, 0.1));
  const Frame plain_one = outputs_of(find_technique("sssr"), pair, {}, {.math = Math::precise});
  const Frame stereo =
      outputs_of(find_technique("stereo-ssr"), pair, {{"traversal", "mono"}, {"fade", "mono"}, {"reprojection", "off"}},
                 {.math = Math::precise});
  EXPECT_TRUE(same_bits(plain_one, stereo));
}

// --- A sequence

/// The room again, with a nearly perfect mirror, so that it has a lobe, and a wall whose colour changes smoothly.
struct SmoothRoom : MirrorRoom {
  explicit SmoothRoom(const Shot& shot_, double eye_x = 0, float roughness = 0.04f, const Post& post_ = {})
      : MirrorRoom(shot_, eye_x, post_) {
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const dvec3 color = is_floor(x, y) ? dvec3(0) : smooth(point(x, y));
        for (size_t i = 0; i < 3; ++i) plane_of(frame, "color").channels[i].at(x, y) = float(color[int(i)]);
        plane_of(frame, "roughness").channels[0].at(x, y) = roughness;
      }
    }
  }
  static dvec3 smooth(const dvec3& p) { return {0.5 + 0.4 * std::sin(4 * p.x), 0.5 + 0.4 * std::cos(4 * p.y), 0.5}; }

  /// Adds the history `reflection`, of a number of frames, from the eye's earlier position.
  void follow(const MirrorRoom& before, const Plane& reflection, float frames) {
    View& view = frame.views[0];
    view.camera_before = before.frame.views[0].camera;
    const auto take = [&](const std::string& name, const Plane& plane) {
      view.planes[name] = plane.clone();
      view.planes[name].name = name;
    };
    take("history", reflection);
    take("history_depth", *before.frame.views[0].find("depth"));
    for (const char* name : {"motion", "history_frames"}) plane_of(frame, name);
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const glm::dvec2 there = before.projected(point(x, y)) - glm::dvec2(x + 0.5, y + 0.5);
        for (const int i : {0, 1}) plane_of(frame, "motion").channels[size_t(i)].at(x, y) = float(there[i]);
        plane_of(frame, "history_frames").channels[0].at(x, y) = frames;
      }
    }
  }

  /// The exact image in the mirror; a is 1.
  Plane exact() const {
    Plane reflection{"reflection", {}};
    for (int c = 0; c < 4; ++c) reflection.channels.emplace_back(Layout(shot.width, shot.height), c == 3 ? 1.0f : 0.0f);
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const dvec3 color = is_floor(x, y) ? smooth(reflected(x, y)) : dvec3(0);
        for (size_t c = 0; c < 3; ++c) reflection.channels[c].at(x, y) = float(color[int(c)]);
      }
    }
    return reflection;
  }
};

const Settings all_of_history = {{"most_frames", "1024"}, {"kept_within", "1000000"}, {"fade_border", "0"}};

/// RMSE over the part of the floor that both images show, away from their borders.
double rmse_on_floor(const SmoothRoom& room, const SmoothRoom& before, const Plane& test) {
  const Plane exact = room.exact();
  double squares = 0;
  long count = 0;
  for (int y = 0; y < room.shot.height; ++y) {
    for (int x = 0; x < room.shot.width; ++x) {
      const bool counts = room.is_floor(x, y) && room.shows(room.reflected(x, y), 8) &&
                          before.shows(room.reflected(x, y), 8) && before.shows(room.point(x, y), 8);
      for (size_t c = 0; counts && c < 3; ++c) {
        const double off = double(test.channels[c].at(x, y)) - double(exact.channels[c].at(x, y));
        squares += off * off;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 1000);
  return std::sqrt(squares / double(count));
}

TEST(TemporalReflection, WhatAMirrorShowsMovesAsItsVirtualImage) {
  for (const Shot& shot : shots()) {
    const SmoothRoom before(shot);
    SmoothRoom now(shot, 0.3);
    now.follow(before, before.exact(), 1e6f);
    for (const RunOptions& options : {RunOptions{.math = Math::precise, .lanes = 1}, RunOptions{.math = Math::fast}}) {
      const Frame found = outputs_of(find_technique("temporal-sssr"), now.frame, all_of_history, options);
      Frame lost = clone(now.frame);
      lost.views[0].camera_before.reset();
      const Frame as_surface = outputs_of(find_technique("temporal-sssr"), lost, all_of_history, options);
      const double a = rmse_on_floor(now, before, *found.views[0].find("reflection"));
      const double b = rmse_on_floor(now, before, *as_surface.views[0].find("reflection"));
      std::printf("as its image %.4f, as the surface %.4f\n", a, b);
      EXPECT_LT(a, 0.02);
      // Reflections of parallel rays move with the surface.
      EXPECT_GT(b, shot.camera.orthographic ? 0.99 * a : 5 * a);
    }
  }
}

TEST(TemporalReflection, AStandingImageIsTheMeanOfItsFrames) {
  const Shot shot = perspective(96, 64, 70);
  SmoothRoom room(shot, 0, 0.5f);
  const RunOptions first{.math = Math::precise, .seed = 1}, second{.math = Math::precise, .seed = 2};
  const Frame a = outputs_of(find_technique("sssr"), room.frame, {}, first),
              b = outputs_of(find_technique("sssr"), room.frame, {}, second);
  room.follow(room, *a.views[0].find("reflection"), 3);
  const Frame both = outputs_of(find_technique("temporal-sssr"), room.frame, {{"kept_within", "1000000"}}, second);
  double worst = 0;
  int compared = 0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (!room.is_floor(x, y)) continue;
      EXPECT_NEAR(both.views[0].find("frames")->channels[0].at(x, y), 4, 1e-4);
      // Pixels without any find among their neighbours now keep nothing.
      if (b.views[0].find("reflection")->channels[3].at(x, y) < 0.01) continue;
      ++compared;
      for (size_t c = 0; c < 4; ++c) {
        const auto at = [&](const Frame& frame) {
          return double(frame.views[0].find("reflection")->channels[c].at(x, y));
        };
        worst = std::max(worst, std::abs(at(both) - (3 * at(a) + at(b)) / 4));
      }
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_LT(worst, 1e-4);
}

TEST(TemporalReflection, WhatAMaskLeftOutIsNotTakenOver) {
  const Shot shot = perspective(96, 64, 70);
  SmoothRoom room(shot, 0, 0.5f);
  const Frame alone = outputs_of(find_technique("sssr"), room.frame, {}, {.math = Math::precise});
  Plane before = room.exact();
  for (Channel& channel : before.channels) {
    for (int y = 0; y < shot.height; ++y)
      for (int x = 0; x < shot.width / 2; ++x) channel.at(x, y) = 0;
  }
  room.follow(room, before, 5);
  Channel& frames = plane_of(room.frame, "history_frames").channels[0];
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width / 2; ++x) frames.at(x, y) = 0;
  const Frame after = outputs_of(find_technique("temporal-sssr"), room.frame, {}, {.math = Math::precise});
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (!room.is_floor(x, y) || x == shot.width / 2 - 1 || x == shot.width / 2) continue;
      EXPECT_NEAR(after.views[0].find("frames")->channels[0].at(x, y), x < shot.width / 2 ? 1 : 6, 1e-4) << x;
      if (x >= shot.width / 2) continue;
      EXPECT_EQ(after.views[0].find("reflection")->channels[0].at(x, y),
                alone.views[0].find("reflection")->channels[0].at(x, y))
          << x << ", " << y;
    }
  }
}

TEST(TemporalReflection, MirrorsAndWhatWasHiddenAreOfThisFrameAlone) {
  const Shot shot = perspective(96, 64, 70);
  for (const bool is_mirror : {true, false}) {
    SmoothRoom room(shot, 0, is_mirror ? 0.0f : 0.5f);
    const Frame alone = outputs_of(find_technique("sssr"), room.frame, {}, {.math = Math::precise});
    room.follow(room, room.exact(), 5);
    if (!is_mirror) {
      Channel& depth = plane_of(room.frame, "history_depth").channels[0];
      for (int y = 0; y < shot.height; ++y)
        for (int x = 0; x < shot.width; ++x) depth.at(x, y) *= 1.2f;
    }
    const Frame after = outputs_of(find_technique("temporal-sssr"), room.frame, {}, {.math = Math::precise});
    EXPECT_EQ(difference(*alone.views[0].find("reflection"), *after.views[0].find("reflection")).max, 0) << is_mirror;
    for (int y = 0; y < shot.height; ++y)
      for (int x = 0; x < shot.width; ++x)
        EXPECT_EQ(after.views[0].find("frames")->channels[0].at(x, y), room.is_floor(x, y) ? 1 : 0) << is_mirror;
  }
}

// --- Fade

/// Confidence of a hit at this distance from the border of an image, in sizes of the image.
double faded(double from_border, double width) {
  const double t = std::clamp(from_border / width, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Distance of a point from the border of the image that shows it, in sizes of the image; 0 beyond it.
double to_border(const MirrorRoom& room, const dvec3& point) {
  const glm::dvec2 at = room.projected(point) / glm::dvec2(room.shot.width, room.shot.height);
  return std::max(std::min({at.x, 1 - at.x, at.y, 1 - at.y}), 0.0);
}

/// Largest errors of confidence and colour for fading by `border_of`, and the number of pixels at which another border would
/// differ.
struct Fading {
  int compared = 0, told_apart = 0;
  double worst = 0, worst_color = 0;
};

template <typename BorderOf>
Fading fading_of(const Frame& out, const std::array<const MirrorRoom*, 2>& eyes, const BorderOf& border_of) {
  constexpr double width = 0.3, environment = 5;
  Fading f;
  for (const size_t view : {0, 1}) {
    const MirrorRoom &own = *eyes[view], &other = *eyes[1 - view];
    for (int y = 0; y < own.shot.height; ++y) {
      for (int x = 0; x < own.shot.width; ++x) {
        if (!own.is_floor(x, y)) continue;
        const dvec3 met = own.reflected(x, y);
        // Within a pixel of a border, rounding decides which image shows the point.
        const bool is_shown = own.shows(met, 1) || (other.shows(met, 1) && !own.shows(met, -1));
        if (!is_shown || from_edge(met) < 0.1) continue;
        const double here = to_border(own, met), there = to_border(other, met);
        const double expected = faded(border_of(here, there), width);
        ++f.compared;
        f.told_apart += std::abs(faded(here, width) - faded(there, width)) > 0.05;
        f.worst = std::max(f.worst, std::abs(confidence(out, view).at(x, y) - expected));
        const double red = expected * checker(met).x + (1 - expected) * environment;
        f.worst_color =
            std::max(f.worst_color, std::abs(out.views[view].find("reflection")->channels[0].at(x, y) - red));
      }
    }
  }
  return f;
}

// The position of a hit that is farther from the border of its image decides, for both eyes alike; without the stereo fade, the
// one in the image that found the hit.
TEST(StereoReflection, HitsFadeByTheImageThatShowsThemFartherFromItsBorder) {
  for (const Shot& shot : shots()) {
    const MirrorRoom left(shot, -0.2), right(shot, 0.2);
    Frame pair = pair_of(left, right);
    for (const char* fade : {"stereo", "mono"}) {
      const Frame out =
          outputs_of(find_technique("stereo-ssr"), pair,
                     {{"fade", fade}, {"fade_border", "0.3"}, {"environment_r", "5"}}, {.math = Math::precise});
      const bool is_stereo = fade == std::string("stereo");
      const Fading f = fading_of(out, {&left, &right}, [&](double here, double there) {
        return is_stereo ? std::max(here, there) : here > 0 ? here : there;
      });
      std::printf("%s: compared %d pixels, %d tell the borders apart: worst confidence %.1e, worst color %.1e\n", fade,
                  f.compared, f.told_apart, f.worst, f.worst_color);
      EXPECT_GT(f.compared, 2500);
      EXPECT_GT(f.told_apart, 500);
      EXPECT_LT(f.worst, 1e-4);
      EXPECT_LT(f.worst_color, 1e-3);
    }
  }
}

// --- Rays of the other eye

/// Two eyes before a glossy floor of strips that belong to two objects alternately, and a post before the wall. Colours tell a
/// ray's origin: the left eye's image is red, the right one's green, each pixel in a shade of its own.
struct GlossyPair {
  std::array<SmoothRoom, 2> eyes;
  Frame frame;

  explicit GlossyPair(const Shot& shot) : eyes{room(shot, -0.2), room(shot, 0.2)}, frame(pair_of(eyes[0], eyes[1])) {
    for (const size_t eye : {0, 1}) {
      std::mt19937 random(uint32_t(eye + 1));
      View& view = frame.views[eye];
      for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
          for (Channel& channel : view.planes.at("color").channels) channel.at(x, y) = 0;
          const bool is_floor = eyes[eye].is_floor(x, y), is_odd = int(std::floor(eyes[eye].point(x, y).x / 0.6)) & 1;
          const float shade = std::uniform_real_distribution(0.25f, 1.0f)(random);
          if (!is_floor) view.planes.at("color").channels[eye].at(x, y) = shade;
          view.planes.at("instance").channels[0].at(x, y) = !is_floor ? 3 : is_odd ? 1 : 2;
        }
      }
    }
  }

  static SmoothRoom room(const Shot& shot, double eye_x) {
    return SmoothRoom(shot, eye_x, 0.2f, {.low_x = -0.5, .high_x = 0.5, .bottom = -0.7});
  }

  /// One ray per pixel and no neighbours, so that each pixel has its own ray and at most one of the other eye.
  Frame reflections(const char* reprojection) {
    return outputs_of(find_technique("stereo-ssr"), frame,
                      {{"neighbours", "1"},
                       {"other_neighbours", "1"},
                       {"reprojection", reprojection},
                       {"traversal", "mono"},
                       {"fade", "mono"},
                       {"fade_border", "0"}},
                      {.math = Math::precise});
  }

  /// Pixel in which the other eye sees the virtual image of a point this far along the mirror ray of a pixel: on the line from
  /// the virtual image, behind the floor, to that eye.
  glm::dvec2 same_virtual_image(size_t eye, int x, int y, double length) const {
    const MirrorRoom &own = eyes[eye], &other = eyes[1 - eye];
    const dvec3 away = glm::normalize(turned(ray_through(own.shot, x + 0.5, y + 0.5).direction, -down));
    const dvec3 image = own.point(x, y) + length * away;
    const dvec3 to_eye = own.shot.camera.orthographic ? -away : other.eye - image;
    return other.projected(image + to_eye * ((floor_height - image.y) / to_eye.y));
  }
};

/// The other eye's rays of one kind at the virtual images of pixels.
struct Counted {
  int asked = 0, taken = 0,
      wrong = 0;  ///< rays that changed the pixel, and that came from another pixel
};

struct Shared {
  Counted alike, longer, missed, of_another_object;  ///< longer: or shorter, by more than half
};

/// `alone` and `together`: without and with the other eye's rays.
Shared shared_by(const GlossyPair& pair, const Frame& alone, const Frame& together, size_t eye) {
  const size_t other = 1 - eye;
  const auto at = [](const Frame& frame, size_t view, const char* plane, size_t channel, const glm::ivec2& p) {
    return double(frame.views[view].find(plane)->channels[channel].at(p.x, p.y));
  };
  const int width = pair.frame.width(), height = pair.frame.height();
  Shared shared;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::ivec2 here(x, y);
      const double length = at(alone, eye, "hit", 0, here);
      if (!pair.eyes[eye].is_floor(x, y) || length == 0) continue;
      const glm::dvec2 place = pair.same_virtual_image(eye, x, y, length), off = glm::fract(place) - 0.5;
      const glm::ivec2 there(glm::floor(place));
      const bool is_inside = there.x >= 0 && there.y >= 0 && there.x < width && there.y < height;
      // Halfway between two pixels rounding decides.
      if (!is_inside || std::max(std::abs(off.x), std::abs(off.y)) > 0.49) continue;
      const bool is_same = at(pair.frame, eye, "instance", 0, here) == at(pair.frame, other, "instance", 0, there);
      const double of_other = at(alone, other, "hit", 0, there), ratio = of_other / length;
      Counted& counted = !is_same                         ? shared.of_another_object
                         : of_other == 0                  ? shared.missed
                         : ratio > 1.5 || ratio < 1 / 1.5 ? shared.longer
                                                          : shared.alike;
      ++counted.asked;
      const double share = 1 - at(together, eye, "reflection", eye, here) / at(alone, eye, "reflection", eye, here);
      const double from_other = at(together, eye, "reflection", other, here);
      if (share < 0.02 && from_other < 0.01) continue;
      ++counted.taken;
      counted.wrong += std::abs(from_other / share - at(alone, other, "reflection", other, there)) > 0.01;
    }
  }
  return shared;
}

// The one ray of the other eye counts that belongs to the pixel where that eye sees the same virtual image, if that pixel shows
// the same object and the ray has met something, however near.
TEST(StereoReflection, RaysOfTheOtherEyeComeFromWhereItSeesTheSameVirtualImage) {
  for (const Shot& shot : shots()) {
    GlossyPair pair(shot);
    const Frame alone = pair.reflections("off"), together = pair.reflections("on");
    for (const size_t eye : {0, 1}) {
      const Shared s = shared_by(pair, alone, together, eye);
      for (const auto& [what, counted] :
           {std::pair("alike", s.alike), std::pair("longer or shorter", s.longer), std::pair("missed", s.missed),
            std::pair("of another object", s.of_another_object)}) {
        std::printf("view %zu, %s: %d of %d count, %d of another pixel\n", eye, what, counted.taken, counted.asked,
                    counted.wrong);
        EXPECT_EQ(counted.wrong, 0);
      }
      EXPECT_GT(s.alike.taken, 0.9 * s.alike.asked);
      EXPECT_GT(s.alike.asked, 1000);
      EXPECT_GT(s.longer.taken, 10);
      EXPECT_GT(s.missed.asked, 20);
      EXPECT_EQ(s.missed.taken, 0);
      // Eyes whose rays are all parallel see each strip at the same position.
      EXPECT_GT(s.of_another_object.asked, shot.camera.orthographic ? 10 : 500);
      EXPECT_EQ(s.of_another_object.taken, 0);
    }
  }
}

// --- Against rays, in a scene with rough and smooth surfaces

struct Errors {
  double rmse, ssim;
};

Plane colours(const Plane& plane) {
  Plane out = plane.clone();
  out.channels.pop_back();
  return out;
}

Errors errors_of(const Frame& frame, const Frame& truth, size_t view) {
  const Channel& depth = truth.views[view].find("depth")->channels[0];
  Mask mask;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) mask.push_back(!is_background(depth.at(x, y)));
  const Metrics m = compare(colours(*frame.views[view].find("reflection")),
                            colours(*truth.views[view].find("reflection")), mask, truth.numbers.at("gloamExposure"));
  return {m.rmse, m.ssim};
}

TEST(StereoReflection, IsNearerToTheTruthThanThePlainOne) {
  ONLY_IN_LONG_RUN();
  const gloam::Scene scene = load_scene("gallery", {});
  const Tracer tracer(scene);
  CaptureOptions options{.width = 320, .height = 180, .planes = {}};
  options.planes = {"normal", "color", "roughness", "reflectance", "back_depth", "instance"};
  options.views = {{"", camera_for(scene.cameras.front(), options.width, options.height), {}}};
  options.stereo = StereoRig{.interpupillary_distance = 0.065};
  Frame pair = std::move(capture(tracer, options).frame);
  const Reference truth = reflection_reference(tracer, pair, {.samples = 64});
  const Frame plain_one = outputs_of(find_technique("sssr"), pair, {}, {.math = Math::precise});
  const Frame stereo = outputs_of(find_technique("stereo-ssr"), pair, {}, {.math = Math::precise});
  for (const size_t view : {0, 1}) {
    const Errors a = errors_of(plain_one, truth.frame, view), b = errors_of(stereo, truth.frame, view);
    std::printf("view %zu: RMSE %.5f and %.5f, SSIM %.4f and %.4f\n", view, a.rmse, b.rmse, a.ssim, b.ssim);
    EXPECT_LT(b.rmse, a.rmse);
    EXPECT_GT(b.ssim, a.ssim);
    EXPECT_LT(a.rmse, 0.04);
  }
}

/// A kitchen rendered by Cycles, with the light that its surfaces reflect (two bounces): GlossInd is light from other surfaces;
/// light from the sky, and from lamps, which the image does not show, is GlossDir.
class Kitchen : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = std::filesystem::path(GLOAM_CAPTURES) / "kitchen";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no captures at " << folder;
    FrameFile reference(folder / "kitchen_reflection_ref.exr",
                        {.as_stored = true, .channels = {{"color", "ViewLayer.GlossInd"}}});
    truth = std::move(reference.read({"color"}).views[0].planes.at("color"));
    for (const char* reflectance : {"ViewLayer.GlossCol", "none"}) {
      FrameFile file(folder / "kitchen_user.exr", {.channels = {{"reflectance", reflectance}}});
      frames.push_back(file.read(file.common_planes()));
    }
  }

  /// Surfaces up to this roughness; with `shown`, only those for which 90 % of the reflected light was found on a surface.
  Mask where(const Frame& reflections, double most_roughness, bool shown = true) const {
    const View &found = reflections.views[0], &frame = frames[0].views[0];
    Mask mask;
    for (int y = 0; y < reflections.height(); ++y) {
      for (int x = 0; x < reflections.width(); ++x) {
        const auto at = [&](const View& view, const char* plane, size_t c = 0) {
          return double(view.find(plane)->channels[c].at(x, y));
        };
        const bool is_found = at(found, "reflection", 3) >= 0.9 && at(found, "hit") > 0;
        mask.push_back(!is_background(float(at(frame, "depth"))) && at(frame, "roughness") <= most_roughness &&
                       (is_found || !shown));
      }
    }
    return mask;
  }

  Metrics error_of(const Plane& reflection, const Mask& mask) const {
    constexpr double exposure = 7;  // the brightest hundredth of the truth begins at about 1 / 7
    return compare(reflection, truth, mask, exposure);
  }

  Plane truth;
  std::vector<Frame> frames;  ///< with the reflectance of the file, and without it
};

TEST_F(Kitchen, ReflectsAboutWhatItsRendererSays) {
  ONLY_IN_LONG_RUN();
  const Settings rays = {{"rays", "4"}};
  const Frame too_bright = outputs_of(find_technique("sssr"), frames[0], rays, {});
  const Frame found = outputs_of(find_technique("sssr"), frames[1], rays, {});
  Plane black{"color", {}};
  for (int c = 0; c < 3; ++c) black.channels.emplace_back(truth.channels[0].layout(), 0.0f);
  const auto count = [](const Mask& mask) { return double(std::count(mask.begin(), mask.end(), 1)); };
  for (const double roughness : {1.0, 0.1}) {
    const Mask mask = where(found, roughness);
    const double share = count(mask) / count(where(found, 1, false));
    const Metrics m = error_of(colours(*found.views[0].find("reflection")), mask), of_black = error_of(black, mask),
                  of_file = error_of(colours(*too_bright.views[0].find("reflection")), mask);
    std::printf("%.1f %% of the surfaces, roughness up to %.1f: RMSE %.4f, SSIM %.3f, bias %.4f\n", 100 * share,
                roughness, m.rmse, m.ssim, m.bias);
    std::printf("  black: %.4f, %.3f, %.4f; with GlossCol: %.4f, %.3f, %.4f\n", of_black.rmse, of_black.ssim,
                of_black.bias, of_file.rmse, of_file.ssim, of_file.bias);
    EXPECT_GT(share, 0.15);
    EXPECT_LT(m.rmse, 0.9 * of_black.rmse);
    EXPECT_GT(m.ssim, of_black.ssim + 0.15);
    EXPECT_LT(std::abs(m.bias), 0.2 * std::abs(of_black.bias));
    EXPECT_LT(m.rmse, of_file.rmse / 4);
  }
}

}  // namespace
}  // namespace gloam::test::reflection_test
