// Hard case 11: images of every shape. What lies beside an image in memory must not reach it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "hard_case.h"

namespace gloam::test {
namespace {

/// Everything beside the image becomes a value that would show.
void spoil_padding(Frame& frame, float value) {
  for (auto& [name, plane] : frame.views[0].planes) {
    for (Channel& channel : plane.channels) channel.fill_padding(value);
  }
}

TEST_P(HardCase, Row11SizesAndPadding) {
  SKIP_WHERE_OPTED_OUT(11);
  const Settings few = few_samples(technique());
  int changed = 0, tried = 0;
  for (const auto& [width, height] :
       {std::pair(1, 1), {1, 33}, {33, 1}, {2, 2}, {15, 3}, {16, 3}, {17, 13}, {16384, 1}, {1, 16384}, {32769, 3}}) {
    const double fov = width > 1000 ? 150 : 60;
    for (const Shot& shot : {perspective(width, height, fov), orthographic(width, height, width * 0.05)}) {
      Frame frame = shoot(shot, room());
      const Frame expected = outputs_of(technique(), frame, few, {.math = Math::precise, .lanes = 1});
      EXPECT_EQ(violation(expected), "") << width << "x" << height;
      EXPECT_EQ(expected.width(), width);
      EXPECT_EQ(expected.height(), height);
      for (const int lanes : usual_lanes(device())) {
        for (const float beside : {0.37f, 5.0f}) {
          Frame spoilt = clone(frame);
          spoil_padding(spoilt, beside);
          const bool same =
              same_bits(outputs_of(technique(), spoilt, few, {.math = Math::precise, .lanes = lanes}), expected);
          EXPECT_TRUE(same) << width << "x" << height << ", lanes " << lanes << ", " << beside << " beside the image";
          changed += !same;
          ++tried;
        }
      }
    }
  }
  report(11, fmt::format("share of {} images that depend on lanes or on what lies beside them", tried),
         double(changed) / tried, 0);
}

/// Kilobytes after a key of /proc; -1 where there is no such thing.
long kilobytes(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key + ":")) return std::stol(line.substr(key.size() + 1));
  }
  return -1;
}

long peak_kilobytes() { return kilobytes("/proc/self/status", "VmHWM"); }
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

constexpr int large = 8192, tile = 256;

/// A wall with square blocks before it, the same in every tile: one look per tile tells all.
Frame blocks() {
  Shot shot = orthographic(large, large, large / 64.0);
  Frame frame = blank(shot);
  for (const char* name : {"depth", "normal"}) plane_of(frame, name);
  Plane& normal = plane_of(frame, "normal");
  Channel& depth = plane_of(frame, "depth").channels[0];
  for (int y = 0; y < large; ++y) {
    std::fill_n(normal.channels[2].row(y), large, 1.0f);
    for (int x = 0; x < large; ++x) depth.row(y)[x] = (x % tile < tile / 2) == (y % tile < tile / 2) ? 2.0f : 2.2f;
  }
  return frame;
}

double mean_of_tile(const Channel& channel, int x0, int y0) {
  double sum = 0;
  for (int y = y0; y < y0 + tile; ++y) {
    for (int x = x0; x < x0 + tile; ++x) sum += channel.at(x, y);
  }
  return sum / (tile * tile);
}

/// The costliest technique in memory among those that fit, with its cheapest preset.
TEST(Row11, LargestImage) {
  const Layout layout(large, large);
  const Technique* chosen = nullptr;
  Plan plan;
  for (const Technique& technique : registry()) {
    Frame small = shoot(perspective(8, 8), room());
    const std::vector<std::string> given = plane_names(small);
    const Settings lengths = set_lengths(technique, small, [](double) { return 0.5; });
    const Plan candidate = plan_for(technique, small, lengths);
    if (plane_names(small) != given || technique.views > 1 || unit_interval_outputs(candidate).empty())
      continue;  // needs more than depth and normals of one view
    if (device_bytes(candidate, layout) > device().info().memory) continue;
    if (!chosen || device_bytes(candidate, layout) > device_bytes(plan, layout)) chosen = &technique, plan = candidate;
  }
  // Inputs are the host's own pages on a CPU; on other devices they exist twice.
  const long available = kilobytes("/proc/meminfo", "MemAvailable");
  if (!chosen) GTEST_SKIP() << "no technique of depth and normals alone fits " << device().info().name;
  const double needed = double(device_bytes(plan, layout)) * 1.2;
  if (available >= 0 && double(available) * 1024 < needed)
    GTEST_SKIP() << "needs " << needed / 1e9 << " GB, and " << double(available) / 1e6 << " are free";

  Frame warm_up = shoot(perspective(64, 64), room());
  run(plan, warm_up, device());  // the compiler's memory is not the image's
  const Frame frame = blocks();
  forget_peak();
  const long before = peak_kilobytes();
  const RunResult result = run(plan, frame, device(), {.repeat = 1});
  const double grown = double(peak_kilobytes() - before) * 1024, predicted = double(result.device_bytes);
  const double inputs = 4.0 * double(layout.bytes());
  EXPECT_EQ(result.frame.width(), large);
  EXPECT_EQ(result.device_bytes, device_bytes(plan, layout));
  for (const std::string& name : unit_interval_outputs(plan)) {
    const Channel& values = result.frame.views[0].find(name)->channels[0];
    const double first = mean_of_tile(values, tile, tile);
    EXPECT_GT(first, 0.3);
    EXPECT_LT(first, 0.999) << "the blocks cast no occlusion";
    double worst = 0;
    for (int y = tile; y < large - tile; y += tile) {
      for (int x = tile; x < large - tile; x += tile)
        worst = std::max(worst, std::abs(mean_of_tile(values, x, y) - first));
    }
    std::printf(
        "hard case 11  %s  worst %.3g  bound %.3g  (8192x8192: %s, difference between the means of like tiles)\n",
        chosen->name.c_str(), worst, 2e-3, name.c_str());
    EXPECT_LE(worst, 2e-3);
  }
  if (before < 0 || !device().info().shares_memory) return;
  std::printf("hard case 11  %s  worst %.3g  bound %.3g  (8192x8192: memory over the prediction, share)\n",
              chosen->name.c_str(), (grown + inputs) / predicted - 1, 0.05);
  EXPECT_LE(grown + inputs, predicted * 1.05)
      << grown << " bytes beside " << inputs << " of inputs, where " << predicted << " are predicted";
}

}  // namespace
}  // namespace gloam::test
