// A frame read by rows, and its figures, equal those of the whole frame.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <vector>

#include "gloam/exr.h"
#include "gloam/metrics.h"

namespace gloam::exr_rows_test {
namespace {

namespace fs = std::filesystem;

constexpr int width = 45, height = 70;

/// A slope with normals in 0..1, holes in each plane, and an unknown plane.
std::map<std::string, std::vector<float>> values() {
  std::map<std::string, std::vector<float>> channels;
  for (const char* name : {"Z", "N.X", "N.Y", "N.Z", "R", "G", "B", "AO", "backZ"}) {
    std::vector<float>& pixels = channels[name];
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) pixels.push_back(0.5f + 0.4f * std::sin(float(x + 7 * y) + float(name[0])));
  }
  for (int i = 0; i < width * height; ++i) {
    channels["Z"][size_t(i)] = i % 11 == 0 ? 1e10f : 4.0f + 0.01f * float(i / width);
    channels["N.X"][size_t(i)] = 0.5f;
    channels["N.Y"][size_t(i)] = 0.5f;
    channels["N.Z"][size_t(i)] = i % 13 == 0 ? 0.5f : 1.0f;
    if (i % 17 == 0) channels["G"][size_t(i)] = NAN;
  }
  return channels;
}

/// Tiles that are cut by the rows asked for.
void write_tiled(const fs::path& path) {
  Imf::Header header(width, height);
  header.setTileDescription(Imf::TileDescription(16, 24));
  Imf::FrameBuffer buffer;
  auto channels = values();
  for (auto& [name, pixels] : channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), sizeof(float),
                                   sizeof(float) * size_t(width)));
  }
  Imf::TiledOutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

class Rows : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-rows-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

const std::vector<std::string> planes = {"depth", "normal", "color", "ao", "back_depth"};

ReadOptions looking() {
  ReadOptions options;
  options.as_stored = true;
  options.count_nonfinite = true;
  return options;
}

/// Reads all rows, `step` at a time, and compares them with the whole frame.
void expect_same_by_rows(const fs::path& path, int step) {
  FrameFile one(path, looking()), other(path, looking());
  const Frame whole = one.read(planes);
  const Frame surveyed = other.survey(planes);
  EXPECT_EQ(surveyed.assumed, whole.assumed);
  for (int first = 0; first < whole.height(); first += step) {
    const int last = std::min(first + step, whole.height());
    const Frame rows = other.read_rows(planes, first, last);
    for (const auto& [name, plane] : whole.views[0].planes) {
      const Plane* part = name == "depth" ? surveyed.views[0].find(name) : rows.views[0].find(name);
      ASSERT_TRUE(part) << name;
      const int shift = name == "depth" ? 0 : first;
      for (size_t c = 0; c < plane.channels.size(); ++c)
        for (int y = first; y < last; ++y)
          EXPECT_EQ(std::memcmp(plane.channels[c].row(y), part->channels[c].row(y - shift), sizeof(float) * width), 0)
              << name << " " << c << " row " << y << " of steps of " << step;
    }
  }
  for (const std::string& plane : planes) EXPECT_EQ(other.nonfinite(plane, ""), one.nonfinite(plane, "")) << plane;
  EXPECT_EQ(other.normal_space(), one.normal_space());
}

TEST_F(Rows, AreThoseOfTheWholeFrameScanlines) {
  const fs::path tiled = folder / "tiled.exr", lines = folder / "lines.exr";
  write_tiled(tiled);
  write_frame(lines, FrameFile(tiled, looking()).read(planes));
  for (const int step : {1, 16, 27, height}) expect_same_by_rows(lines, step);
}

TEST_F(Rows, AreThoseOfTheWholeFrameTiles) {
  write_tiled(folder / "tiled.exr");
  for (const int step : {1, 16, 24, 27, height}) expect_same_by_rows(folder / "tiled.exr", step);
}

Plane part_of(const Plane& plane, int first, int last) {
  Plane part{plane.name, {}};
  for (const Channel& from : plane.channels) {
    Channel& to = part.channels.emplace_back(Layout(from.layout().width, last - first));
    for (int y = first; y < last; ++y)
      std::memcpy(to.row(y - first), from.row(y), sizeof(float) * size_t(from.layout().width));
  }
  return part;
}

Plane pattern(const std::string& name, size_t components, int rows, float shift) {
  Plane plane{name, {}};
  for (size_t c = 0; c < components; ++c) {
    Channel& channel = plane.channels.emplace_back(Layout(width, rows), 0.0f);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < width; ++x)
        channel.at(x, y) = 0.5f + 0.4f * std::sin(0.3f * float(x) + 0.2f * float(y) * float(c + 1) + shift);
  }
  return plane;
}

TEST(Comparison, ByRowsGivesTheSameBits) {
  for (const int rows : {257, 600, 1024}) {
    for (const double exposure : {0.0, 1.5}) {
      for (const bool colours : {false, true}) {
        const Plane test = pattern(colours ? "color" : "ao", colours ? 3 : 1, rows, 0),
                    truth = pattern(test.name, test.channels.size(), rows, 0.1f);
        Mask mask(size_t(width) * size_t(rows));
        for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % 7 != 0 && i / size_t(width) > 20;
        Comparison comparison(rows, exposure);
        for (int first = 0; first < rows; first += Comparison::step) {
          const int last = std::min(first + Comparison::step, rows), top = std::max(first - Comparison::reach(), 0),
                    bottom = std::min(last + Comparison::reach(), rows);
          const Plane a = part_of(test, top, bottom), b = part_of(truth, top, bottom);
          const Mask part(mask.begin() + long(top) * width, mask.begin() + long(bottom) * width);
          comparison.add({a, b, part, top}, first, last);
        }
        const Metrics whole = compare(test, truth, mask, exposure), by_rows = comparison.figures();
        EXPECT_EQ(by_rows.pixels, whole.pixels);
        EXPECT_EQ(by_rows.rmse, whole.rmse);
        EXPECT_EQ(by_rows.mae, whole.mae);
        EXPECT_EQ(by_rows.max, whole.max);
        EXPECT_EQ(by_rows.ssim, whole.ssim);
        EXPECT_EQ(by_rows.gmsd, whole.gmsd);
        EXPECT_EQ(by_rows.flip, whole.flip);
        EXPECT_EQ(by_rows.rse, whole.rse);
      }
    }
  }
}

}  // namespace
}  // namespace gloam::exr_rows_test
