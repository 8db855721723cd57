// The depth levels of Scalable Ambient Obscurance: the pixels that they hold, and that a sample read from them lies on the
// surface of its pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gloam/normalise.h"
#include "support/depth_layers.h"
#include "support/estimate.h"

namespace gloam::test::sao_test {
namespace {

Settings with(const char* levels, const char* radius, const char* level_offset = "3") {
  return {{"levels", levels}, {"radius", radius}, {"level_offset", level_offset}, {"strength", "0.5"}};
}

std::vector<Shot> shots() {
  return {perspective(93, 61), orthographic(93, 61, 4), perspective(640, 40), perspective(17, 200),
          perspective(1, 9),   perspective(300, 1),     perspective(33, 32)};
}

/// The pass that makes the first level, alone, so that the level can be read.
Plan first_level_alone() {
  const Technique& technique = find_technique("sao");
  ParameterValues values(technique.parameters);
  values.set("levels", "on", "sao");
  Pass pass = technique.passes(values).front();
  pass.writes.front().layers = 1;
  Plan plan;
  plan.technique = "sao";
  plan.inputs = {"depth"};
  plan.outputs = {pass.writes.front().plane};
  plan.passes.push_back({&technique, pass, values});
  return plan;
}

TEST(SaoLevels, TheFirstIsARotatedGridOfTheDepth) {
  for (const Shot& shot : shots()) {
    Frame frame = blank(shot);
    Channel& depth = plane_of(frame, "depth").channels[0];
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) depth.at(x, y) = float(1 + x + y * shot.width);
    }
    normalise(frame);
    for (const int lanes : {1, 4, 8, 16}) {
      const Frame out = run(first_level_alone(), frame, device(), {.lanes = lanes}).frame;
      const Channel& level = out.views[0].find("sao_levels")->channels[0];
      const auto expected = [&](int x, int y) {
        const int column = std::min(2 * x + (y & 1), shot.width - 1), row = std::min(2 * y + (x & 1), shot.height - 1);
        return plane_of(frame, "depth").channels[0].at(column, row);
      };
      int wrong = 0;
      for (int y = 0; y < (shot.height + 1) / 2; ++y) {
        for (int x = 0; x < (shot.width + 1) / 2; ++x) wrong += level.at(x, y) != expected(x, y);
      }
      EXPECT_EQ(wrong, 0) << shot.width << "x" << shot.height << ", lanes " << lanes;
    }
  }
}

/// The technique over layers reads the same pixels from the layers themselves: the levels' values, and the positions of samples,
/// are the same to the bit, at any resolution.
TEST(SaoLevels, HoldThePixelsThatTheyStandFor) {
  for (const Shot& shot : {perspective(93, 61), orthographic(93, 61, 4), perspective(300, 1)}) {
    const Frame frame = with_layers(shoot(shot, room()), {same_depth});
    for (const char* radius : {"0.5", "inf"}) {
      for (const int resolution : {1, 2}) {
        for (const int lanes : usual_lanes(device())) {
          for (const char* level_offset : {"0", "3"}) {
            const Settings settings = with("on", radius, level_offset);
            EXPECT_TRUE(same_bits(raw_of("sao", frame, settings, {.lanes = lanes}, resolution),
                                  raw_of("dp-sao", frame, settings, {.lanes = lanes}, resolution)))
                << shot.width << "x" << shot.height << ", radius " << radius << ", resolution " << resolution
                << ", lanes " << lanes << ", level_offset " << level_offset;
          }
        }
      }
    }
  }
}

TEST(SaoLevels, OnlyFarSamplesAreReadFromThem) {
  const Frame frame = shoot(perspective(240, 180), room());
  // 0.03 units are at most 6 pixels and 0.5 up to 100: level 1 begins at 2^(level_offset + 1) pixels.
  EXPECT_TRUE(same_bits(raw_of("sao", frame, with("on", "0.03")), raw_of("sao", frame, with("off", "0.03"))));
  EXPECT_TRUE(same_bits(raw_of("sao", frame, with("on", "0.5", "8")), raw_of("sao", frame, with("off", "0.5"))));
  EXPECT_FALSE(same_bits(raw_of("sao", frame, with("on", "0.5")), raw_of("sao", frame, with("off", "0.5"))));
}

/// Levels move samples by up to half their distance in pixels, but never off the surface of their pixel.
TEST(SaoLevels, APlaneStaysFlat) {
  for (const Shot& shot : {perspective(320, 240), orthographic(320, 240, 3)}) {
    for (const double tilt : {0.0, 0.7, 1.3}) {
      const Frame frame = shoot(shot, tilted_plane(3, tilt, 0.4));
      for (const char* bias : {"0.0001", "0"}) {
        const Settings settings = joined(with("on", "1.5", "0"), {{"bias", bias}});
        const Frame out = raw_of("sao", frame, settings, {.math = Math::precise});
        EXPECT_LE(largest_occlusion(out), bias[1] == '\0' ? 2e-5 : 0) << "tilt " << tilt << ", bias " << bias;
      }
    }
  }
}

/// With many samples, reading far ones from levels changes nothing on average, and little at a pixel.
TEST(SaoLevels, ChangeLittle) {
  for (const Shot& shot : {perspective(480, 360), orthographic(480, 360, 4)}) {
    const Frame frame = shoot(shot, room());
    const Settings many = {{"samples", "1000"}, {"strength", "2"}};
    const Settings on = joined(with("on", "0.6"), many), off = joined(with("off", "0.6"), many);
    const Frame with_levels = raw_of("sao", frame, on), without = raw_of("sao", frame, off);
    double sum = 0, squares = 0, occlusion = 0;
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        const double d = double(raw_at(with_levels, x, y)) - raw_at(without, x, y);
        sum += d;
        squares += d * d;
        occlusion += 1 - raw_at(without, x, y);
      }
    }
    const double count = double(shot.width) * shot.height;
    std::printf("sao, levels on against off, %s: mean difference %.2g, RMSE %.2g; mean occlusion %.2g\n",
                shot.camera.orthographic ? "orthographic" : "perspective", sum / count, std::sqrt(squares / count),
                occlusion / count);
    EXPECT_GT(occlusion / count, 0.03) << "the case tests nothing";
    EXPECT_LE(std::abs(sum / count), 1e-3);
    EXPECT_LE(std::sqrt(squares / count), 1e-2);
  }
}

}  // namespace
}  // namespace gloam::test::sao_test
