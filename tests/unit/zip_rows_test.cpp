// Rows of ZIP and ZIPS files, against the values that OpenEXR compressed.
#include "exr/zip_rows.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "gloam/exr.h"
#include "unit/message_of.h"

namespace gloam::zip_rows_test {
namespace {

namespace fs = std::filesystem;

/// A file of three channels, of which the middle one is half, with the values of a seed.
struct ZipFile {
  int width, height;
  Imf::Compression compression;
  bool is_noise;
  int x0 = 0, y0 = 0;

  float value(int channel, int x, int y) const {
    const uint64_t number = uint64_t(y) * 4096 + uint64_t(x);
    const float noise = float(Random(uint64_t(channel), number).uniform(0, 1));
    const float value = is_noise ? noise : float(channel + x / 3 + y / 5);
    return channel == 1 ? float(half(value)) : value;
  }

  void write(const std::string& path) const {
    const Imath::Box2i window({x0, y0}, {x0 + width - 1, y0 + height - 1});
    Imf::Header header(window, window);
    header.compression() = compression;
    Imf::FrameBuffer buffer;
    std::vector<float> floats[3];
    std::vector<half> halves;
    for (int c = 0; c < 3; ++c) {
      const std::string name(1, char('A' + c));
      header.channels().insert(name, Imf::Channel(c == 1 ? Imf::HALF : Imf::FLOAT));
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) floats[c].push_back(value(c, x, y));
      if (c == 1) halves.assign(floats[c].begin(), floats[c].end());
      if (c == 1)
        buffer.insert(name, Imf::Slice::Make(Imf::HALF, halves.data(), window, 2, 2 * size_t(width)));
      else
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, floats[c].data(), window, 4, 4 * size_t(width)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }
};

class ZipRowsOf : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-zip-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    path = (folder / "f.exr").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Decodes rows [first, last) of two channels into a window that is two pixels wider on each side.
  bool decode(const ZipFile& file, int first, int last, Channel& a, Channel& b) const {
    Imf::MultiPartInputFile input(path.c_str());
    Imf::InputPart part(input, 0);
    const Window window{file.x0 - 2, file.y0, file.x0 + file.width + 2, file.y0 + file.height};
    PartDecoding decoding;
    decoding["B"].targets = {&a};
    decoding["C"].targets = {&b};
    return decode_zip_rows(part, decoding, window, first, last);
  }

  void expect_values(const ZipFile& file, int first, int last) const {
    const Layout layout(file.width + 4, file.height);
    Channel a(layout, -7), b(layout, -7);
    ASSERT_TRUE(decode(file, file.y0 + first, file.y0 + last, a, b));
    for (int y = 0; y < file.height; ++y) {
      const bool is_wanted = y >= first && y < last;
      for (int x = 0; x < file.width; ++x) {
        ASSERT_EQ(a.at(x + 2, y), is_wanted ? file.value(1, x, y) : -7) << x << " " << y;
        ASSERT_EQ(b.at(x + 2, y), is_wanted ? file.value(2, x, y) : -7) << x << " " << y;
      }
      ASSERT_EQ(a.at(1, y), -7);
      ASSERT_EQ(b.at(file.width + 2, y), -7);
    }
  }

  fs::path folder;
  std::string path;
};

TEST_F(ZipRowsOf, FilesHaveTheValuesThatWereWritten) {
  for (const Imf::Compression compression : {Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
    for (const bool is_noise : {false, true}) {
      for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 15), std::pair(33, 17), std::pair(200, 50)}) {
        const ZipFile file{width, height, compression, is_noise, -3, 11};
        SCOPED_TRACE(fmt::format("{}x{}, compression {}, noise {}", width, height, int(compression), is_noise));
        file.write(path);
        expect_values(file, 0, height);
        if (height > 16) expect_values(file, 5, height - 1);
        if (height > 16) expect_values(file, 15, 16);
      }
    }
  }
}

TEST_F(ZipRowsOf, OtherFilesAreLeftToOpenExr) {
  const Layout layout(24, 20);
  Channel a(layout), b(layout);
  for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    const ZipFile file{20, 20, compression, false};
    file.write(path);
    EXPECT_FALSE(decode(file, 0, 20, a, b)) << int(compression);
  }
}

/// Whatever byte is damaged: refused, or decoded without harm.
TEST_F(ZipRowsOf, DamagedFilesDoNoHarm) {
  const ZipFile file{64, 40, Imf::ZIP_COMPRESSION, false};
  file.write(path);
  std::ifstream stream(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  const Layout layout(68, 40);
  int refused = 0;
  const size_t begin = whole.size() / 3;
  for (size_t i = begin; i < whole.size(); i += 1 + (whole.size() - begin) / 200) {
    std::string damaged = whole;
    damaged[i] = char(damaged[i] ^ 0x5a);
    std::ofstream(path, std::ios::binary) << damaged;
    Channel a(layout), b(layout);
    try {
      refused += !decode(file, 0, 40, a, b);
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100) << "the checksum tells";
}

// --- Chunks that hold too little

/// What stands for `size` bytes in a chunk of a compression.
std::string packed(Imf::Compression compression, size_t size) {
  const std::string zeros(size, '\0');
  if (compression == Imf::NO_COMPRESSION) return zeros;
  if (compression == Imf::RLE_COMPRESSION) {  // runs of 128
    std::string runs;
    for (size_t i = 0; i < size / 128; ++i) runs += std::string("\x7f\0", 2);
    return runs;
  }
  // One stored block of zlib, and its checksum.
  std::string stream = {0x78, 0x01, 0x01, char(size & 255), char(size >> 8), char(~size & 255), char(~size >> 8 & 255)};
  const uint32_t checksum = uint32_t(size % 65521) << 16 | 1;
  for (const int shift : {24, 16, 8, 0}) stream.insert(stream.size(), 1, char(checksum >> shift));
  return stream.insert(7, zeros);
}

/// Where the table of a file's four chunks begins: the first of them begins where it ends.
size_t table_in(const std::string& bytes) {
  for (size_t table = 0;; ++table) {
    uint64_t offset = 0;
    std::memcpy(&offset, bytes.data() + table, sizeof offset);
    if (offset == table + 4 * sizeof offset) return table;
  }
}

/// A file of four rows of 256 floats, each a chunk or a tile, whose third holds 1/share of what its row needs.
void write_with_short_chunk(const std::string& path, Imf::Compression compression, size_t share, bool is_tiled) {
  constexpr int width = 256, height = 4;
  Imf::Header header(width, height);
  header.compression() = compression;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  const std::vector<float> values(width * height, 0.0f);
  Imf::FrameBuffer buffer;
  buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 4 * width));
  if (is_tiled) {
    header.setTileDescription({width, 1});
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, 0, 0, height - 1);
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const size_t table = table_in(bytes);
  bytes.resize(table + 8 * height);
  for (int y = 0; y < height; ++y) {
    const uint64_t offset = bytes.size();
    std::memcpy(bytes.data() + table + 8 * size_t(y), &offset, sizeof offset);
    const std::string data = y == 2 ? packed(compression, 4 * width / share) : std::string(4 * width, '\0');
    std::vector<int32_t> head = {y, int32_t(data.size())};
    if (is_tiled) head = {0, y, 0, 0, int32_t(data.size())};
    bytes.append(reinterpret_cast<const char*>(head.data()), sizeof(int32_t) * head.size()).append(data);
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

class ChunksOf : public testing::TestWithParam<bool> {};

/// OpenEXR would take the rest of the row from what its memory held before, and other values in each run.
TEST_P(ChunksOf, TooLittleAreDamage) {
  const std::string path = fs::temp_directory_path() / ("gloam-short-chunk-" + std::to_string(getpid()) + ".exr");
  const std::string chunk = GetParam() ? "the chunk of tile 0, 2" : "the chunk of row 2";
  for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
    write_with_short_chunk(path, compression, 2, GetParam());
    EXPECT_EQ(test::message_of([&] { FrameFile(path, {.fov_degrees = 60}).read({"depth"}); }),
              path + ": truncated or corrupted EXR (" + chunk + " holds 512 of 1024 bytes); render or copy it again")
        << compression;
    const ReadOptions without_depth{.fov_degrees = 60, .channels = {{"depth", "none"}}};
    EXPECT_NE(test::message_of([&] { FrameFile(path, without_depth).verify(); }).find(chunk), std::string::npos)
        << compression;
    if (compression == Imf::ZIPS_COMPRESSION) continue;  // a stored block is larger than what it holds
    write_with_short_chunk(path, compression, 1, GetParam());
    EXPECT_EQ(test::message_of([&] { FrameFile(path, {.fov_degrees = 60}).read({"depth"}); }), "no error")
        << compression;
  }
  fs::remove(path);
}

/// OpenEXR would find the tile by itself, and take what it lacks from memory.
TEST(ChunksThatHoldTooLittle, ATableThatDoesNotLeadToATileIsDamage) {
  const std::string path = fs::temp_directory_path() / ("gloam-lost-tile-" + std::to_string(getpid()) + ".exr");
  write_with_short_chunk(path, Imf::NO_COMPRESSION, 2, true);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  file.seekp(std::streamoff(table_in(bytes) + 2 * sizeof(uint64_t)));
  file.write(std::string(8, 0).data(), 8);
  file.close();
  EXPECT_NE(test::message_of([&] {
              FrameFile(path, {.fov_degrees = 60}).read({"depth"});
            }).find("the table of tiles does not lead to tile 0, 2"),
            std::string::npos);
  fs::remove(path);
}

INSTANTIATE_TEST_SUITE_P(Each, ChunksOf, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "tiles" : "rows"; });

}  // namespace
}  // namespace gloam::zip_rows_test
