// Environments: which texel lies in which direction, and what is refused.
#include "gloam/environment_map.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "gloam/environment_file.h"
#include "gloam/error.h"
#include "message_of.h"

namespace gloam::test::environment_map_test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

EnvironmentMap empty_map(EnvironmentAxes axes, double turn = 0) {
  return EnvironmentMap(16, 8, std::vector<vec3>(16 * 8), axes, turn);
}

void expect_place(const EnvironmentMap& map, const dvec3& direction, double x, double y) {
  const dvec2 place = map.place(direction);
  EXPECT_NEAR(place.x, x, 1e-9) << direction.x << ", " << direction.y << ", " << direction.z;
  EXPECT_NEAR(place.y, y, 1e-9) << direction.x << ", " << direction.y << ", " << direction.z;
}

// ImfEnvmap.h: latitude +pi/2 (the top) is +y; longitude 0 (the middle) +z; longitude +pi/2 +x, and the left edge +pi.
TEST(EnvironmentMap, AxesOfOpenExr) {
  const EnvironmentMap map = empty_map(EnvironmentAxes::openexr);
  expect_place(map, {0, 0, 3}, 8, 4);
  expect_place(map, {1, 0, 0}, 4, 4);
  expect_place(map, {-1, 0, 0}, 12, 4);
  expect_place(map, {0, 1, 1}, 8, 2);
  EXPECT_EQ(map.place({0, 1, 0}).y, 0);
  EXPECT_EQ(map.place({0, -1, 0}).y, 8);
}

TEST(EnvironmentMap, AxesOfBlender) {
  const EnvironmentMap map = empty_map(EnvironmentAxes::blender);
  expect_place(map, {1, 0, 0}, 8, 4);
  expect_place(map, {0, 1, 0}, 4, 4);
  expect_place(map, {0, -1, 0}, 12, 4);
  expect_place(map, {1, 0, 1}, 8, 2);
  EXPECT_EQ(map.place({0, 0, 1}).y, 0);
}

// Counter-clockwise seen from above: about +y from +z to +x, about +z from +x to +y.
TEST(EnvironmentMap, Turned) {
  expect_place(empty_map(EnvironmentAxes::openexr, 90), {1, 0, 0}, 8, 4);
  expect_place(empty_map(EnvironmentAxes::blender, 90), {0, 1, 0}, 8, 4);
  expect_place(empty_map(EnvironmentAxes::blender, -45), {1, -1, 0}, 8, 4);
}

TEST(EnvironmentMap, DirectionsAndPlacesBelongTogether) {
  for (const EnvironmentAxes axes : {EnvironmentAxes::openexr, EnvironmentAxes::blender}) {
    const EnvironmentMap map = empty_map(axes, 33);
    for (double x = 0.25; x < 16; x += 0.5) {
      for (double y = 0.25; y < 8; y += 0.5) {
        EXPECT_NEAR(glm::length(map.direction({x, y})), 1, 1e-12);
        expect_place(map, map.direction({x, y}), x, y);
      }
    }
  }
}

// Texels have their own value in their middle and the mean of two between them, also across the edge of the picture.
TEST(EnvironmentMap, IsInterpolated) {
  std::vector<vec3> texels(16 * 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) texels[size_t(16 * y + x)] = vec3(float(x), float(y), 1);
  const EnvironmentMap map(16, 8, texels);
  const auto at = [&](double x, double y) { return map.radiance(map.direction({x, y})); };
  EXPECT_NEAR(glm::distance(at(3.5, 2.5), dvec3(3, 2, 1)), 0, 1e-9);
  EXPECT_NEAR(glm::distance(at(4, 2.5), dvec3(3.5, 2, 1)), 0, 1e-9);
  EXPECT_NEAR(glm::distance(at(4, 3), dvec3(3.5, 2.5, 1)), 0, 1e-9);
  EXPECT_NEAR(at(15.75, 2.5).x, 0.75 * 15, 1e-9);
  EXPECT_NEAR(at(0.25, 2.5).x, 0.25 * 15, 1e-9);
  EXPECT_NEAR(at(3.5, 0.1).y, 0, 1e-9);
  EXPECT_NEAR(at(3.5, 7.9).y, 7, 1e-9);
}

TEST(EnvironmentMap, RefusesLightThatIsNone) {
  const auto message = [](float value) {
    std::vector<vec3> texels(16 * 8, vec3(1));
    texels[16 * 3 + 5].y = value;
    return message_of([&] { EnvironmentMap(16, 8, texels); });
  };
  EXPECT_EQ(message(-0.5f), "the environment is 1, -0.5, 1 at texel (5, 3); finite radiance from 0 on is allowed");
  EXPECT_NE(message(std::numeric_limits<float>::quiet_NaN()).find("1, nan, 1 at texel (5, 3)"), std::string::npos);
  EXPECT_NE(message(std::numeric_limits<float>::infinity()).find("1, inf, 1"), std::string::npos);
  EXPECT_EQ(message(0), "no error");
  EXPECT_NE(message_of([] { EnvironmentMap(16, 8, std::vector<vec3>(16 * 8), EnvironmentAxes::openexr, NAN); }),
            "no error");
}

// --- Files

class EnvironmentFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "gloam-environment-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Red is x, green y, blue 1.
  std::filesystem::path written(int width, int height, std::optional<Imf::Envmap> kind = {},
                                const char* channels = "RGB", float blue = 1) const {
    std::vector<float> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) pixels.insert(pixels.end(), {float(x), float(y), blue});
    Imf::Header header(width, height);
    if (kind) Imf::addEnvmap(header, *kind);
    Imf::FrameBuffer buffer;
    for (int i = 0; i < 3; ++i) {
      const std::string name(1, channels[i]);
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data() + i), 3 * sizeof(float),
                                     3 * sizeof(float) * size_t(width)));
    }
    const std::filesystem::path path = folder_ / "sky.exr";
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
    return path;
  }

  std::string refusal(const std::filesystem::path& path) const {
    return message_of([&] { read_environment(path); });
  }

  std::filesystem::path folder_;
};

TEST_F(EnvironmentFile, IsRead) {
  const EnvironmentMap map = read_environment(written(32, 16), EnvironmentAxes::blender, 90);
  EXPECT_EQ(map.width(), 32);
  EXPECT_EQ(map.height(), 16);
  EXPECT_EQ(map.texels()[32 * 3 + 5], vec3(5, 3, 1));
  EXPECT_NEAR(map.place({0, 1, 0}).x, 16, 1e-9);
  EXPECT_EQ(read_environment(written(30, 17, Imf::ENVMAP_LATLONG)).height(), 17);
}

TEST_F(EnvironmentFile, IsRefusedIfItIsNone) {
  EXPECT_NE(refusal(written(30, 17)).find("sky.exr: is 30 x 17 and no lat-long environment"), std::string::npos);
  EXPECT_NE(refusal(written(32, 16, Imf::ENVMAP_CUBE)).find("of the kind 'cube'"), std::string::npos);
  EXPECT_NE(refusal(written(32, 16, {}, "XYZ")).find("has no colour"), std::string::npos);
  EXPECT_NE(refusal(written(32, 16, {}, "RGB", -1)).find("sky.exr: the environment is 0, 0, -1 at texel (0, 0)"),
            std::string::npos);
  EXPECT_NE(refusal(written(32, 16, {}, "RGB", NAN)).find("nan"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "none.exr"), "no error");
}

}  // namespace
}  // namespace gloam::test::environment_map_test
