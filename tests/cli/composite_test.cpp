// gloam run --composite: a result laid over the frame's colour.
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <bit>

#include "cli/shot_fixture.h"

namespace gloam::test::composite_test {
namespace {

class Composite : public ShotTest {
 protected:
  /// A step before background, with colours of all kinds: large, negative, not finite.
  static Frame coloured(int number = 0) {
    Frame frame = frame_of(number);
    Plane& color = frame.views[0].planes.at("color");
    Channel& depth = frame.views[0].planes.at("depth").channels[0];
    for (size_t i = 0; i < 3; ++i)
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
          color.channels[i].at(x, y) = 0.01f + 20 * float((x * 131 + y * 977 + int(i) * 7) % 499) / 499;
    const float odd[] = {-0.0f, -3.5f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
    for (int x = 0; x < frame.width(); ++x) {
      depth.at(x, 0) = std::numeric_limits<float>::infinity();
      for (Channel& channel : color.channels) channel.at(x, 0) = odd[x % 4];
    }
    return frame;
  }
  Frame stored(const std::string& name, const std::vector<std::string>& planes) const {
    return FrameFile(path(name), {.as_stored = true}).read(planes);
  }
  Result composite(const Arguments& more) const {
    Arguments all = {"run", "hbao+", file("f.exr"), "--radius", "0.5"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  }
  /// The formula of the documentation, pixel by pixel; what it leaves alone has the same bits.
  void expect_darkened(const Frame& before, const Frame& ao, const Frame& after, double strength,
                       const std::array<double, 3>& tint) const {
    long long changed = 0, kept = 0;
    for (const View& view : before.views)
      for (size_t i = 0; i < 3; ++i)
        for (int y = 0; y < before.height(); ++y)
          for (int x = 0; x < before.width(); ++x) {
            const float c = view.find("color")->channels[i].at(x, y);
            const float open = ao.view(view.name).find("ao")->channels[0].at(x, y);
            const float is = after.view(view.name).find("color")->channels[i].at(x, y);
            const double share = std::max(0.0, 1 - strength * (1 - double(open)) * (1 - tint[i]));
            const float expected = share == 1 ? c : float(c * share);
            ASSERT_EQ(std::bit_cast<uint32_t>(is), std::bit_cast<uint32_t>(expected)) << x << " " << y << " " << c;
            ++(share == 1 ? kept : changed);
          }
    EXPECT_GT(changed, 100);
    EXPECT_GT(kept, 100);
  }
};

TEST_F(Composite, IsColourTimesAO) {
  const Frame frame = coloured();
  write_frame(path("f.exr"), frame);
  ASSERT_EQ(composite({"-o", file("ao.exr"), "--float", "--composite", file("c.exr")}).status, 0);
  const Frame before = stored("f.exr", {"color"}), ao = stored("ao.exr", {"ao"});
  expect_darkened(before, ao, stored("c.exr", {"color"}), 1, {0, 0, 0});
  EXPECT_EQ(FrameFile(path("c.exr"), {}).all_channels(), (std::vector<std::string>{"B", "G", "R"}));
  ASSERT_EQ(composite({"--composite", file("c.exr"), "--composite-strength", "0.7", "--tint", "0.3,0.1,1"}).status, 0);
  expect_darkened(before, ao, stored("c.exr", {"color"}), 0.7, {0.3, 0.1, 1});
  ASSERT_EQ(composite({"--composite", file("c.exr"), "--composite-strength", "5"}).status, 0);
  expect_darkened(before, ao, stored("c.exr", {"color"}), 5, {0, 0, 0});
  ASSERT_EQ(composite({"--composite", file("c.exr"), "--composite-strength", "0"}).status, 0);
  EXPECT_TRUE(same_bits(before, stored("c.exr", {"color"})));
}

TEST_F(Composite, KeepsHalfAlphaAndAttributes) {
  Frame frame = coloured();
  frame.views[0].planes["alpha"] = Plane{"alpha", {}};
  frame.views[0].planes["alpha"].channels.emplace_back(Layout(64, 48), 0.3f);
  frame.attributes["renderer.note"] = "kept";
  write_frame(path("f.exr"), frame, {.half_planes = {"color"}});
  ASSERT_EQ(composite({"--composite", file("c.exr")}).status, 0);
  const FrameFile made(path("c.exr"), {});
  EXPECT_EQ(made.text_attribute("renderer.note"), "kept");
  EXPECT_EQ(made.text_attribute("gloamComposite"), "ao strength=1 tint=0,0,0");
  EXPECT_TRUE(made.camera(""));
  for (const PlaneSource& source : made.planes())
    EXPECT_EQ(source.channels[0].type, source.plane == "color" ? "half" : "float") << source.plane;
  EXPECT_TRUE(same_bits(stored("f.exr", {"alpha"}), stored("c.exr", {"alpha"})));
  ASSERT_EQ(composite({"--composite", file("c.exr"), "--bare"}).status, 0);
}

TEST_F(Composite, ChromaticitiesStay) {
  write_frame(path("plain.exr"), coloured());
  const Imf::Chromaticities wide({0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f});
  {
    Imf::InputFile from(file("plain.exr").c_str());
    Imf::Header header = from.header();
    Imf::addChromaticities(header, wide);
    Imf::OutputFile to(file("f.exr").c_str(), header);
    to.copyPixels(from);
  }
  ASSERT_EQ(composite({"--composite", file("c.exr"), "--into", file("copy.exr")}).status, 0);
  for (const char* name : {"c.exr", "copy.exr"}) {
    const Imf::MultiPartInputFile made(file(name).c_str());
    for (int part = 0; part < made.parts(); ++part) {
      ASSERT_TRUE(Imf::hasChromaticities(made.header(part))) << name;
      EXPECT_EQ(Imf::chromaticities(made.header(part)), wide);
    }
  }
}

TEST_F(Composite, AddsReflections) {
  ASSERT_EQ(gloam({"capture", "gallery", "-o", file("f.exr"), "--size", "96x54", "--planes",
                   "normal,color,roughness,reflectance"})
                .status,
            0);
  const Arguments run = {"run",         "sssr",        file("f.exr"),          "-o", file("r.exr"),
                         "--composite", file("c.exr"), "--composite-strength", "0.5"};
  const Result result = gloam(run);
  ASSERT_EQ(result.status, 0) << result.err;
  const Frame before = stored("f.exr", {"color"}), reflection = stored("r.exr", {"reflection"}),
              after = stored("c.exr", {"color"});
  long long changed = 0;
  for (size_t i = 0; i < 3; ++i)
    for (int y = 0; y < 54; ++y)
      for (int x = 0; x < 96; ++x) {
        const float c = before.views[0].find("color")->channels[i].at(x, y);
        const float more = reflection.views[0].find("reflection")->channels[i].at(x, y);
        ASSERT_EQ(after.views[0].find("color")->channels[i].at(x, y), float(c + 0.5 * double(more)));
        changed += more > 0;
      }
  EXPECT_GT(changed, 100);
  Arguments tinted = run;
  tinted.insert(tinted.end(), {"--tint", "0,0,0"});
  expect_refused(tinted, 2, {"--tint", "reflection"});
}

TEST_F(Composite, OfTwoEyesAndInACopy) {
  Frame pair = coloured();
  pair.views[0].name = "left";
  pair.views[0].camera->pose = Pose{};
  Frame other = coloured(7);
  other.views[0].name = "right";
  other.views[0].camera->pose = Pose{};
  pair.views.push_back(std::move(other.views[0]));
  write_frame(path("f.exr"), pair);
  ASSERT_EQ(composite({"-o", file("ao.exr"), "--float", "--composite", file("c.exr")}).status, 0);
  const Frame ao = stored("ao.exr", {"ao"});
  ASSERT_EQ(ao.views.size(), 2u);
  expect_darkened(pair, ao, stored("c.exr", {"color"}), 1, {0, 0, 0});
  const Result in_copy = composite({"--into", file("copy.exr"), "--composite", file("copy.exr")});
  ASSERT_EQ(in_copy.status, 0) << in_copy.err;
  const Imf::MultiPartInputFile copy(file("copy.exr").c_str());
  std::vector<std::string> names;
  for (int part = 1; part < copy.parts(); ++part) names.push_back(copy.header(part).name());
  EXPECT_EQ(names, (std::vector<std::string>{"gloam.ao.left", "gloam.ao.right", "gloam.composite.left",
                                             "gloam.composite.right"}));
  EXPECT_TRUE(same_bits(stored("f.exr", {"color", "depth"}), stored("copy.exr", {"color", "depth"})))
      << "the copy's own colour is the input's";
  for (const char* view : {"left", "right"}) {
    const ReadOptions options{
        .views = {view}, .as_stored = true, .channels = {{"color", fmt::format("gloam.composite.{}:R,G,B", view)}}};
    const Frame of_copy = FrameFile(path("copy.exr"), options).read({"color"});
    const Frame made = stored("c.exr", {"color"});
    EXPECT_EQ(difference(of_copy.views[0].planes.at("color"), made.view(view).planes.at("color")).max, 0);
  }
}

TEST_F(Composite, OfAShot) {
  for (const int number : {1, 2}) write_frame(path(numbered("shot", number)), coloured(number));
  const auto shot = [&](const Arguments& more) {
    Arguments all = {"run", "hbao+", file("shot.####.exr"), "--radius", "0.5"};
    all.insert(all.end(), more.begin(), more.end());
    return gloam(all);
  };
  ASSERT_EQ(
      shot({"-o", file("ao.####.exr"), "--float", "--composite", file("c.####.exr"), "--composite-strength", "0.5"})
          .status,
      0);
  for (const int number : {1, 2})
    expect_darkened(stored(numbered("shot", number), {"color"}), stored(numbered("ao", number), {"ao"}),
                    stored(numbered("c", number), {"color"}), 0.5, {0, 0, 0});
  fs::remove(path("c.0002.exr"));
  const Result resumed = shot({"-o", file("ao.####.exr"), "--float", "--composite", file("c.####.exr"),
                               "--composite-strength", "0.5", "--resume", "--json", "-"});
  EXPECT_EQ(lines_of(resumed.out).back()["skipped"], 1) << resumed.out;
  EXPECT_TRUE(fs::exists(path("c.0002.exr")));
  write_frame(path(numbered("shot", 2)), small_frame(64, 48, {"depth"}));
  const Result result = shot({"--composite", file("c.####.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("frame 2: --composite: no channel is known as the frame's colour"), std::string::npos)
      << result.err;
}

TEST_F(Composite, RefusesInOneLine) {
  write_frame(path("f.exr"), coloured());
  write_frame(path("depth.exr"), small_frame(64, 48, {"depth"}));
  const auto with = [&](const Arguments& more) {
    Arguments all = {"run", "hbao+", file("f.exr")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string out = file("c.exr");
  expect_refused({"run", "hbao+", file("depth.exr"), "--composite", out}, 1,
                 {"--composite", "depth.exr has only Z", "--plane color="});
  expect_refused(with({"--composite", out, "--composite-strength", "-1"}), 2, {"--composite-strength", "-1"});
  expect_refused(with({"--composite", out, "--tint", "0.1"}), 2, {"--tint 0.1", "three numbers"});
  expect_refused(with({"--composite", out, "--tint", "0,0,2"}), 2, {"--tint", "2"});
  expect_refused(with({"-o", out, "--composite-strength", "1"}), 2, {"--composite-strength", "--composite"});
  expect_refused(with({"-o", out, "--tint", "0,0,0"}), 2, {"--tint", "--composite"});
  expect_refused(with({"--composite", file("f.exr")}), 2, {"--composite", "is also the frame"});
  expect_refused(with({"-o", out, "--composite", out}), 2, {"--composite", "is also -o"});
  expect_refused(with({"--composite", file("c.jpg")}), 2, {"--composite", ".exr"});
  expect_refused(with({"--composite", file("c.####.exr")}), 2, {"--composite", "is a pattern"});
  expect_refused({"run", "normals", file("f.exr"), "--composite", out}, 2, {"--composite", "makes only normal"});
}

}  // namespace
}  // namespace gloam::test::composite_test
