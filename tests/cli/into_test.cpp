// gloam run --into: a copy of the frame's file with all that it holds, bit for bit, and the result as a further part.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <list>
#include <optional>

#include "cli/shot_fixture.h"
#include "gloam/exr_copy.h"

namespace gloam::test::into_test {
namespace {

constexpr int into_width = 67, into_height = 45;

/// How a part of an input is stored.
struct StoredPart {
  std::string name, view;
  std::vector<std::string> channels;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  std::optional<Imf::LevelMode> tiles = std::nullopt;
  Imf::PixelType type = Imf::FLOAT;
};

float stored_value(const std::string& channel, int x, int y) {
  const bool is_depth = channel.ends_with("Z");
  const float rough = float((x * 7919 + y * 104729) % 1009) / 1009;
  return is_depth ? 2 + float(x / 20) + 0.01f * rough : rough;
}

Imf::Header header_of_stored(const StoredPart& part) {
  Imf::Header header(into_width, into_height, 1, Imath::V2f(0, 0), 1, part.order, part.compression);
  if (!part.name.empty()) header.setName(part.name);
  if (!part.view.empty()) header.setView(part.view);
  if (part.tiles) header.setTileDescription(Imf::TileDescription(16, 24, *part.tiles));
  header.setType(part.tiles ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  header.insert("renderer.note", Imf::StringAttribute("kept as it is"));
  header.insert("renderer.gain", Imf::FloatAttribute(0.1f));
  Imf::addTimeCode(header, Imf::TimeCode(0x12345678, 0x9abcdef0));
  if (part.compression == Imf::DWAA_COMPRESSION) header.insert("dwaCompressionLevel", Imf::FloatAttribute(90));
  for (const std::string& channel : part.channels) header.channels().insert(channel, Imf::Channel(part.type));
  return header;
}

/// Pixels of a part; one level's are the same as another's corner.
struct StoredPixels {
  std::list<std::vector<char>> memory;
  Imf::FrameBuffer buffer;
  explicit StoredPixels(const StoredPart& part) {
    for (const std::string& channel : part.channels) {
      const size_t size = part.type == Imf::HALF ? 2 : 4;
      std::vector<char>& bytes = memory.emplace_back(size * size_t(into_width) * size_t(into_height));
      for (int y = 0; y < into_height; ++y)
        for (int x = 0; x < into_width; ++x) {
          const float value = stored_value(channel, x, y);
          char* at = bytes.data() + size * (size_t(y) * size_t(into_width) + size_t(x));
          if (part.type == Imf::HALF)
            *reinterpret_cast<half*>(at) = half(value);
          else
            *reinterpret_cast<float*>(at) = value;
        }
      buffer.insert(channel, Imf::Slice(part.type, bytes.data(), size, size * size_t(into_width)));
    }
  }
};

void write_tiles(Imf::TiledOutputPart& output) {
  for (int y = 0; y < output.numYLevels(); ++y)
    for (int x = 0; x < output.numXLevels(); ++x)
      if (output.isValidLevel(x, y)) output.writeTiles(0, output.numXTiles(x) - 1, 0, output.numYTiles(y) - 1, x, y);
}

void write_stored(const fs::path& path, const std::vector<StoredPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const StoredPart& part : parts) headers.push_back(header_of_stored(part));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    StoredPixels pixels(parts[i]);
    if (parts[i].tiles) {
      Imf::TiledOutputPart output(file, int(i));
      output.setFrameBuffer(pixels.buffer);
      write_tiles(output);
    } else {
      Imf::OutputPart output(file, int(i));
      output.setFrameBuffer(pixels.buffer);
      output.writePixels(into_height);
    }
  }
}

using Bytes = std::string;

/// The value of each attribute as a file holds it.
std::map<std::string, Bytes> attributes_in(const Imf::Header& header) {
  std::map<std::string, Bytes> all;
  for (auto a = header.begin(); a != header.end(); ++a) {
    Imf::StdOSStream stream;
    a.attribute().writeValueTo(stream, 2);
    all[a.name()] = stream.str();
  }
  return all;
}

/// The compressed blocks of a part, by level and place.
std::map<std::vector<int>, Bytes> blocks_in(Imf::MultiPartInputFile& file, int part) {
  std::map<std::vector<int>, Bytes> blocks;
  const std::string type = file.header(part).type();
  const char* data = nullptr;
  int size = 0;
  if (type == Imf::TILEDIMAGE) {
    Imf::TiledInputPart input(file, part);
    for (int ly = 0; ly < input.numYLevels(); ++ly)
      for (int lx = 0; lx < input.numXLevels(); ++lx)
        for (int y = 0; input.isValidLevel(lx, ly) && y < input.numYTiles(ly); ++y)
          for (int x = 0; x < input.numXTiles(lx); ++x) {
            int dx = x, dy = y, level_x = lx, level_y = ly;
            // Of a file of one part, OpenEXR gives the next tile, whichever that is.
            input.rawTileData(dx, dy, level_x, level_y, data, size);
            blocks[{level_x, level_y, dx, dy}] = Bytes(data, size_t(size));
          }
    return blocks;
  }
  Imf::InputPart input(file, part);
  for (int y = 0; y < into_height; ++y) {
    input.rawPixelData(y, data, size);
    blocks[{y}] = Bytes(data, size_t(size));
  }
  return blocks;
}

/// All of the original stands at the beginning of the copy.
void expect_kept(const fs::path& original, const fs::path& copy) {
  Imf::MultiPartInputFile before(original.c_str()), after(copy.c_str());
  ASSERT_GT(after.parts(), before.parts());
  for (int part = 0; part < before.parts(); ++part) {
    const std::map<std::string, Bytes> of_copy = attributes_in(after.header(part));
    for (const auto& [name, value] : attributes_in(before.header(part)))
      EXPECT_TRUE(of_copy.count(name) && of_copy.at(name) == value) << name << " of part " << part;
    const auto blocks = blocks_in(before, part), copied = blocks_in(after, part);
    EXPECT_GT(blocks.size(), 0u);
    EXPECT_TRUE(blocks == copied) << "part " << part;
  }
}

std::vector<std::string> part_names(const fs::path& path) {
  const Imf::MultiPartInputFile file(path.c_str());
  std::vector<std::string> names;
  for (int part = 0; part < file.parts(); ++part) names.push_back(file.header(part).name());
  return names;
}

class Into : public ShotTest {
 protected:
  Arguments into_of(const Arguments& more = {}) const {
    Arguments all = {"run", "hbao+", file("f.exr"), "--into", file("copy.exr"), "--radius", "0.5", "--fov", "60"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Result into(const Arguments& more = {}) const { return gloam(into_of(more)); }
};

const std::vector<std::string> beauty_and_depth = {"R", "G", "B", "Z"};

TEST_F(Into, EachWayOfStoringStaysBitForBit) {
  std::vector<StoredPart> ways;
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION,
        Imf::DWAB_COMPRESSION})
    ways.push_back({"", "", beauty_and_depth, compression, Imf::INCREASING_Y, {}, Imf::HALF});
  ways.push_back({"", "", beauty_and_depth, Imf::ZIP_COMPRESSION, Imf::DECREASING_Y});
  for (const Imf::LevelMode levels : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS})
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y})
      ways.push_back({"", "", beauty_and_depth, Imf::PXR24_COMPRESSION, order, levels});
  for (const StoredPart& way : ways) {
    SCOPED_TRACE(fmt::format("compression {}, order {}, levels {}", int(way.compression), int(way.order),
                             way.tiles ? int(*way.tiles) : -1));
    write_stored(path("f.exr"), {way});
    const Result result = into();
    ASSERT_EQ(result.status, 0) << result.err;
    expect_kept(path("f.exr"), path("copy.exr"));
    const std::vector<std::string> planes = {"depth", "color"};
    const ReadOptions options{.fov_degrees = 60};
    EXPECT_TRUE(
        same_bits(FrameFile(path("f.exr"), options).read(planes), FrameFile(path("copy.exr"), options).read(planes)));
  }
}

TEST_F(Into, PartsStayAndTheResultIsReadAgain) {
  write_stored(path("f.exr"), {{"beauty", "", {"R", "G", "B", "A"}, Imf::DWAB_COMPRESSION},
                               {"depth", "", {"Z"}, Imf::ZIPS_COMPRESSION, Imf::RANDOM_Y, Imf::RIPMAP_LEVELS},
                               {"crypto", "", {"crypto00.R", "crypto00.G"}, Imf::NO_COMPRESSION}});
  ASSERT_EQ(into().status, 0);
  expect_kept(path("f.exr"), path("copy.exr"));
  EXPECT_EQ(part_names(path("copy.exr")), (std::vector<std::string>{"beauty", "depth", "crypto", "gloam.ao"}));
  ASSERT_EQ(
      gloam({"run", "hbao+", file("f.exr"), "-o", file("ao.exr"), "--radius", "0.5", "--fov", "60", "--half"}).status,
      0);
  EXPECT_TRUE(same_bits(FrameFile(path("copy.exr"), {.fov_degrees = 60, .as_stored = true}).read({"ao"}),
                        FrameFile(path("ao.exr"), {.as_stored = true}).read({"ao"})));
  EXPECT_EQ(FrameFile(path("copy.exr"), {}).text_attribute("gloamTechnique"), "hbao+");
  const Result compared = gloam({"compare", file("copy.exr"), file("ao.exr"), "--json", "-"});
  ASSERT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(compared.json()["max"], 0);
}

TEST_F(Into, DeepPartsStay) {
  Imf::Header flat = header_of_stored({"beauty", "", beauty_and_depth});
  Imf::Header deep = header_of_stored({"deep", "", {"Z"}, Imf::ZIPS_COMPRESSION});
  deep.setType(Imf::DEEPSCANLINE);
  const std::vector<Imf::Header> headers = {flat, deep};
  {
    Imf::MultiPartOutputFile file(path("f.exr").c_str(), headers.data(), 2);
    StoredPixels pixels({"beauty", "", beauty_and_depth});
    Imf::OutputPart beauty(file, 0);
    beauty.setFrameBuffer(pixels.buffer);
    beauty.writePixels(into_height);
    std::vector<float> values(2, 3.5f);
    std::vector<unsigned> counts(size_t(into_width) * size_t(into_height), 2);
    std::vector<const float*> pointers(counts.size(), values.data());
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * size_t(into_width)));
    buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), sizeof(float*),
                                      sizeof(float*) * size_t(into_width), sizeof(float)));
    Imf::DeepScanLineOutputPart output(file, 1);
    output.setFrameBuffer(buffer);
    output.writePixels(into_height);
  }
  // Flat parts are read without it, and the note says so; a file of deep parts alone is refused.
  const Result told = gloam({"info", path("f.exr")});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.out.find("part 'deep' is deep"), std::string::npos) << told.out;
  EXPECT_EQ(gloam({"run", "gtao", path("f.exr"), "-o", path("ao.exr")}).status, 0);
  Frame frame = small_frame(into_width, into_height, {"ao"});
  write_copy(path("copy.exr"), path("f.exr"), {{"ao", &frame, {}}});
  Imf::MultiPartInputFile before(file("f.exr").c_str()), after(file("copy.exr").c_str());
  ASSERT_EQ(part_names(path("copy.exr")), (std::vector<std::string>{"beauty", "deep", "gloam.ao"}));
  EXPECT_EQ(blocks_in(before, 0), blocks_in(after, 0));
  Imf::DeepScanLineInputPart deep_before(before, 1), deep_after(after, 1);
  for (int y = 0; y < into_height; ++y) {
    std::vector<char> one(1 << 16), other(1 << 16);
    uint64_t one_size = one.size(), other_size = other.size();
    deep_before.rawPixelData(y, one.data(), one_size);
    deep_after.rawPixelData(y, other.data(), other_size);
    ASSERT_EQ(Bytes(one.data(), one_size), Bytes(other.data(), other_size)) << y;
  }
}

TEST_F(Into, TheInputIsReadAsBefore) {
  // Normals in world space without an attribute, and depth along the ray: nothing that a new part says may change it.
  Frame frame = small_frame(64, 48, {"depth", "normal", "color"});
  write_frame(path("g.exr"), frame);
  ASSERT_EQ(
      gloam({"run", "gtao", file("g.exr"), "--into", file("copy.exr"), "--with", "bent_normal", "--radius", "0.5"})
          .status,
      0);
  const Result before = gloam({"info", file("g.exr"), "--json", "-"}),
               after = gloam({"info", file("copy.exr"), "--json", "-"});
  ASSERT_EQ(after.status, 0) << after.err;
  EXPECT_EQ(before.json()["camera"], after.json()["camera"]);
  EXPECT_EQ(before.json()["depth_convention"], after.json()["depth_convention"]);
  write_stored(path("f.exr"), {{"", "", {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z"}}});
  ASSERT_EQ(gloam({"run", "gtao", file("f.exr"), "--into", file("copy.exr"), "--with", "bent_normal", "--radius", "0.5",
                   "--fov", "60"})
                .status,
            0);
  const Imf::MultiPartInputFile file(path("copy.exr").c_str());
  EXPECT_EQ(file.header(0).find("gloamNormalSpace"), file.header(0).end());
  EXPECT_NE(file.header(1).find("gloamNormalSpace"), file.header(1).end());
  const std::vector<std::string> planes = {"depth", "normal", "color"};
  const ReadOptions options{.fov_degrees = 60};
  Frame one = FrameFile(path("f.exr"), options).read(planes), other = FrameFile(path("copy.exr"), options).read(planes);
  EXPECT_TRUE(same_bits(one, other));
  EXPECT_EQ(one.assumed, other.assumed);
}

TEST_F(Into, TwoEyesGetAPartEach) {
  Frame pair = small_frame(64, 48);
  pair.views[0].name = "left";
  pair.views[0].camera->pose = Pose{};
  pair.views.push_back({"right", pair.views[0].camera, {}, glm::dvec3(0), {}});
  for (const auto& [name, plane] : pair.views[0].planes) pair.views[1].planes[name] = plane.clone();
  write_frame(path("f.exr"), pair);
  const std::vector<StoredPart> by_view = {{"depth.left", "left", {"Z"}}, {"depth.right", "right", {"Z"}}};
  const std::vector<StoredPart> by_name = {{"left", "", {"Z"}}, {"right", "", {"Z"}}};
  const auto check = [&] {
    ASSERT_EQ(into().status, 0);
    expect_kept(path("f.exr"), path("copy.exr"));
    const std::vector<std::string> names = part_names(path("copy.exr"));
    EXPECT_EQ(names[names.size() - 2], "gloam.ao.left");
    EXPECT_EQ(names[names.size() - 1], "gloam.ao.right");
    const FrameFile copy(path("copy.exr"), {});
    EXPECT_EQ(copy.views(), (std::vector<std::string>{"left", "right"}));
    EXPECT_EQ(copy.common_planes(), [&] {
      std::vector<std::string> planes = FrameFile(path("f.exr"), {}).common_planes();
      planes.push_back("ao");
      return planes;
    }());
  };
  check();
  for (const auto& parts : {by_view, by_name}) {
    write_stored(path("f.exr"), parts);
    check();
  }
  ASSERT_EQ(into({"--view", "right"}).status, 0);
  EXPECT_EQ(part_names(path("copy.exr")).back(), "gloam.ao.right");
  EXPECT_EQ(part_names(path("copy.exr")).size(), 3u);
}

TEST_F(Into, AFurtherResultIsAFurtherPart) {
  write_stored(path("f.exr"), {{"", "", beauty_and_depth}});
  ASSERT_EQ(into().status, 0);
  EXPECT_EQ(FrameFile(path("copy.exr"), {}).planes().back().channels[0].type, "half");
  const Result again =
      gloam({"run", "hbao+", file("copy.exr"), "--into", file("again.exr"), "--radius", "1", "--fov", "60", "--float"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("'gloam.ao' already, and the new one replaces it"), std::string::npos) << again.err;
  EXPECT_EQ(part_names(path("again.exr")), (std::vector<std::string>{"rgba", "gloam.ao"}));
  EXPECT_EQ(FrameFile(path("again.exr"), {}).planes().back().channels[0].type, "float");
  ASSERT_EQ(gloam({"run", "normals", file("copy.exr"), "--into", file("third.exr"), "--fov", "60"}).status, 0);
  EXPECT_EQ(part_names(path("third.exr")), (std::vector<std::string>{"rgba", "gloam.ao", "gloam.normal"}));
  expect_kept(path("copy.exr"), path("third.exr"));
}

TEST_F(Into, APlaneThatIsThereTwiceIsTold) {
  write_stored(path("f.exr"), {{"", "", {"R", "G", "B", "Z", "AO"}}});
  const Result result = into();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("the input has 'ao' too"), std::string::npos) << result.err;
  const Result named = gloam({"info", file("copy.exr"), "--plane", "ao=gloam.ao:AO", "--json", "-"});
  ASSERT_EQ(named.status, 0) << named.err;
  EXPECT_NE(named.out.find("half"), std::string::npos) << named.out;
}

/// gloam's own luminance of a result is not called unread; that of others is, also where gloam added a part.
TEST_F(Into, InfoListsTheLuminanceOfOthers) {
  write_stored(path("f.exr"), {{"", "", {"Z", "Y"}}});
  ASSERT_EQ(into().status, 0);
  EXPECT_EQ(gloam({"info", file("copy.exr"), "--json", "-"}).json()["unread"], nlohmann::json({"Y"}));
}

TEST_F(Into, InfoListsThePartThatIsNotRead) {
  write_stored(path("f.exr"), {{"", "", {"R", "G", "B", "Z", "AO"}}});
  ASSERT_EQ(into().status, 0);
  const Arguments info = {"info", file("copy.exr"), "--json", "-"};
  EXPECT_EQ(gloam(info).json()["unread"], nlohmann::json({"gloam.ao:AO"}));
  EXPECT_NE(gloam({"info", file("copy.exr")}).out.find("not read: gloam.ao:AO\n"), std::string::npos);
  Arguments chosen = info;
  chosen.insert(chosen.end(), {"--plane", "ao=gloam.ao:AO"});
  EXPECT_EQ(gloam(chosen).json()["unread"], nlohmann::json({"rgba:AO"}));
}

TEST_F(Into, BesideAnOutputOfItsOwn) {
  write_stored(path("f.exr"), {{"", "", beauty_and_depth}});
  ASSERT_EQ(into({"-o", file("ao.exr")}).status, 0);
  EXPECT_EQ(FrameFile(path("ao.exr"), {}).all_channels(), (std::vector<std::string>{"AO", "Y"}));
  EXPECT_EQ(FrameFile(path("copy.exr"), {}).all_channels(), (std::vector<std::string>{"B", "G", "R", "Z", "AO"}));
  ASSERT_EQ(into({"--outputs", "ao_raw,ao"}).status, 0);
  EXPECT_EQ(FrameFile(path("copy.exr"), {}).all_channels().size(), 6u);
}

TEST_F(Into, AShot) {
  make_shot({1, 2, 3});
  const auto shot = [&](const Arguments& more) {
    Arguments all = {"run", "hbao+", file("shot.####.exr"), "--into", file("copy.####.exr"), "--radius", "0.5"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(gloam(shot({})).status, 0);
  for (const int number : {1, 2, 3}) expect_kept(path(numbered("shot", number)), path(numbered("copy", number)));
  const std::map<std::string, std::string> whole = contents("copy.");
  ASSERT_EQ(whole.size(), 3u);
  fs::remove(path("copy.0002.exr"));
  const Result resumed = gloam(shot({"--resume", "--json", "-"}));
  EXPECT_EQ(lines_of(resumed.out).back()["skipped"], 2) << resumed.out;
  EXPECT_EQ(contents("copy."), whole);
  const Result both = gloam(shot({"--resume", "-o", file("ao.####.exr"), "--json", "-"}));
  EXPECT_EQ(lines_of(both.out).back()["done"], 3) << both.out << both.err;
  EXPECT_EQ(contents("ao.").size(), 3u);
}

TEST_F(Into, RefusesInOneLine) {
  make_shot({1, 2});
  write_stored(path("f.exr"), {{"", "", beauty_and_depth}});
  const std::string shot = file("shot.####.exr"), one = file("f.exr");
  const auto run_on = [&](const Arguments& more) {
    Arguments all = {"run", "hbao+"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const char* flag : {"--half", "--bare"})
    expect_refused(run_on({one, "--into", file("copy.exr"), flag}), 2, {flag, "which is not given"});
  expect_refused(run_on({shot, "--into", file("copy.####.exr"), "--keep-depth"}), 2,
                 {"--keep-depth", "which is not given"});
  expect_refused(run_on({shot, "--composite", file("c.####.exr"), "--float"}), 2, {"--float", "which is not given"});
  expect_refused(run_on({one, "--into", one}), 2, {"--into", "is also the frame"});
  expect_refused(run_on({one, "-o", file("a.exr"), "--into", file("a.exr")}), 2, {"--into", "is also -o"});
  expect_refused(run_on({one, "--into", file("copy.png")}), 2, {"--into", ".exr"});
  expect_refused(run_on({one, "--into", file("nowhere/copy.exr")}), 1, {"--into", "is not a folder"});
  expect_refused(run_on({one, "--into", file("copy.####.exr")}), 2, {"--into", "is a pattern"});
  expect_refused(run_on({shot, "--into", file("copy.exr")}), 2, {"--into", "is one file"});
  expect_refused(run_on({shot, "--into", shot}), 2, {"--into", "is also what frame 1 is read from"});
  expect_refused(run_on({shot, "-o", file("a.####.exr"), "--into", file("a.%04d.exr")}), 2, {"--into", "is also -o"});
  expect_refused(run_on({file(numbered("shot", 1)), file(numbered("shot", 2)), "--into", file("copy.exr")}), 2,
                 {"--into", "the two eyes are in two"});
}

TEST_F(Into, NothingHalfWrittenStaysWhereSpaceIsLacking) {
  write_frame(path("f.exr"), small_frame(600, 400), {.compression = "none"});
  const std::vector<std::string> before = files();
  rlimit usual{}, tight{};
  getrlimit(RLIMIT_FSIZE, &usual);
  tight = usual;
  tight.rlim_cur = 2 << 20;  // the copy has 4 MB
  setrlimit(RLIMIT_FSIZE, &tight);
  const Result result = into();
  setrlimit(RLIMIT_FSIZE, &usual);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("copy.exr: cannot write: File too large"), std::string::npos) << result.err;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace gloam::test::into_test
