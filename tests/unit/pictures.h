// Planes made from a formula, and PNG files read back.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::test {

using Pattern = std::function<float(int x, int y)>;

inline Plane patterned_plane(const std::string& name, int width, int height, const std::vector<Pattern>& components) {
  Plane plane{name, {}};
  for (const Pattern& pattern : components) {
    Channel channel(Layout(width, height), std::numeric_limits<float>::quiet_NaN());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) channel.at(x, y) = pattern(x, y);
    plane.channels.push_back(std::move(channel));
  }
  return plane;
}

inline Pattern level(float v) {
  return [v](int, int) { return v; };
}

struct Pixel {
  int r, g, b;
  bool operator==(const Pixel&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Pixel& p) { return out << p.r << " " << p.g << " " << p.b; }

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
  Pixel at(int x, int y) const {
    const size_t i = 3 * (size_t(y) * size_t(width) + size_t(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

inline Picture picture_in(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&png, path.c_str())) << png.message;
  png.format = PNG_FORMAT_RGB;
  Picture picture{int(png.width), int(png.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(png))};
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, picture.rgb.data(), 0, nullptr)) << png.message;
  return picture;
}

/// A folder of its own for each test, removed at its end.
class PictureTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             ("gloam_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
              std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
};

}  // namespace gloam::test
