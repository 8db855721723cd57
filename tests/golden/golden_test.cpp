// One small frame per technique is kept, so that any change of a result is noticed. script/update-goldens renews them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

constexpr double per_value = 1e-5;  ///< a value further off counts as changed

/// Precise mathematics gives the same bits on every CPU; a GPU may now and then put a sample into the neighbouring pixel.
double share_allowed() { return device().info().type == "cpu" ? 0 : 0.005; }
double largest_allowed() { return device().info().type == "cpu" ? per_value : 0.5; }

class Golden : public testing::TestWithParam<std::string> {};

std::filesystem::path file_of(const Technique& technique) {
  return std::filesystem::path(GLOAM_SOURCE_DIR) / "tests" / "golden" / (technique.name + ".exr");
}

/// The inputs of a technique for two views, from two eyes each of which sees something that the other does not.
Frame two_eyes(const Technique& technique) {
  Frame pair;
  for (const double offset : {0.0, 0.3}) {
    const Eye eye = eye_at(perspective(64, 48), {offset, 0, 0});
    Frame frame = shoot(eye.shot, seen_by(eye.pose, room()));
    plan_for(technique, frame);  // adds invented planes
    View& view = frame.views[0];
    view.name = pair.views.empty() ? "left" : "right";
    view.camera->pose = eye.pose;
    pair.display = frame.display;
    pair.window = frame.window;
    pair.views.push_back(std::move(view));
  }
  return pair;
}

Frame result_of(const Technique& technique) {
  Frame frame = technique.views == 2 ? two_eyes(technique) : shoot(perspective(64, 48), room());
  // The plane `position` of a file is read only if the file states the camera's pose.
  if (technique.name == "positions") frame.views[0].camera->pose.emplace();
  return outputs_of(technique, frame, {}, {.math = Math::precise, .seed = 1});
}

bool updating() {
  const char* update = std::getenv("GLOAM_UPDATE_GOLDEN");
  return update && std::string(update) == "1";
}

struct Change {
  double values = 0, changed = 0, worst = 0;
};

void add_change(Change& change, const Plane& found, const Plane& expected) {
  for (size_t i = 0; i < found.channels.size(); ++i) {
    const Layout& layout = found.channels[i].layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        const float a = found.channels[i].at(x, y), b = expected.channels[i].at(x, y);
        const double off = a == b                                 ? 0
                           : std::isfinite(a) && std::isfinite(b) ? std::abs(double(a) - double(b))
                                                                  : INFINITY;
        ++change.values;
        change.changed += off > per_value;
        change.worst = std::max(change.worst, off);
      }
    }
  }
}

Change change_of(const Frame& found, const Frame& expected) {
  Change change;
  for (size_t i = 0; i < found.views.size(); ++i) {
    for (const auto& [name, plane] : found.views[i].planes) add_change(change, plane, *expected.views.at(i).find(name));
  }
  return change;
}

/// The kept frame. The planes are those of `found`, so that a technique that writes other planes than before is noticed.
Frame kept(const std::filesystem::path& path, const Frame& found) {
  return FrameFile(path, {}).read(plane_names(found));
}

bool same_planes(const Frame& a, const Frame& b) {
  return plane_names(a) == plane_names(b) && a.width() == b.width() && a.height() == b.height();
}

void update(const std::filesystem::path& path, const Technique& technique, const Frame& found) {
  if (std::filesystem::exists(path)) {
    const Frame before = kept(path, found);
    if (same_planes(before, found)) {
      const Change change = change_of(found, before);
      if (change.worst == 0) return;
      std::printf("golden %s: %.3g %% of values change by more than %g, the furthest by %.3g\n", technique.name.c_str(),
                  100 * change.changed / change.values, per_value, change.worst);
    } else {
      std::printf("golden %s: other planes than before\n", technique.name.c_str());
    }
  } else {
    std::printf("golden %s: new\n", technique.name.c_str());
  }
  write_frame(path, found);
}

TEST_P(Golden, SameAsKept) {
  const Technique& technique = find_technique(GetParam());
  const std::filesystem::path path = file_of(technique);
  const Frame found = result_of(technique);
  ASSERT_EQ(violation(found), "");
  if (updating()) {
    update(path, technique, found);
    return;
  }
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no tests/golden/" << path.filename().string()
                 << " yet; script/update-goldens makes it: look at it before you keep it";
  }
  const Frame expected = kept(path, found);
  ASSERT_TRUE(same_planes(found, expected))
      << "tests/golden/" << path.filename().string() << " holds other planes; script/update-goldens renews it";
  const Change change = change_of(found, expected);
  std::printf("golden %s: %g of %g values changed, the furthest by %.3g\n", technique.name.c_str(), change.changed,
              change.values, change.worst);
  EXPECT_LE(change.changed, share_allowed() * change.values)
      << "the furthest by " << change.worst << "; if it is meant, script/update-goldens renews it";
  EXPECT_LE(change.worst, largest_allowed());
}

INSTANTIATE_TEST_SUITE_P(All, Golden, testing::ValuesIn(technique_names()),
                         [](const testing::TestParamInfo<std::string>& info) { return identifier(info.param); });

}  // namespace
}  // namespace gloam::test
