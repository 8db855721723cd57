// gloam auto: what a frame calls for, what is written either way, and what is refused.
#include "gloam_process.h"
#include "support/frames.h"
#include "support/surfaces.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

using Json = nlohmann::json;

class CliAuto : public Cli {
 protected:
  Result automatic(const Scene& scene, const Arguments& more = {}, const Shot& shot = perspective(200, 120)) const {
    write_frame(path("frame.exr"), shoot(shot, scene));
    Arguments arguments = {"auto", path("frame.exr"), "-o", path("out.exr"), "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  Frame read(const char* name) const {
    FrameFile file(path(name), {});
    return file.read({"ao", "ao_raw"});
  }
  /// Of the only effect there is so far.
  Json effect_of(const Result& result) const { return result.json()["effects"][0]; }
  /// The same planes as gloam run makes with these arguments.
  void expect_same_as_run(const Arguments& more) const {
    Arguments arguments = {"run", "gtao", path("frame.exr"), "-o", path("run.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(gloam(arguments).status, 0);
    const Frame out = read("out.exr"), expected = read("run.exr");
    for (const char* plane : {"ao", "ao_raw"})
      EXPECT_EQ(difference(*out.views[0].find(plane), *expected.views[0].find(plane)).max, 0) << plane;
  }
};

TEST_F(CliAuto, WhatCallsForNothingIsOpenAndNothingIsComputed) {
  const Scene nothing = [](const EyeRay&) { return std::nullopt; };
  for (const Scene& scene : {tilted_plane(3, 0.6, 1), nothing, ball({0, 0, -3}, 0.8)}) {
    const Result result = automatic(scene, {"--math", "precise"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json effect = effect_of(result);
    EXPECT_EQ(effect["name"], "ambient occlusion");
    EXPECT_EQ(effect["wanted"], false);
    EXPECT_EQ(effect["share_of_tiles"], 0);
    EXPECT_EQ(effect["why"], "nothing rises over any surface within the radius");
    EXPECT_EQ(result.json()["total_ms"], result.json()["classify_ms"]);
    expect_same_as_run({"--math", "precise"});
  }
}

TEST_F(CliAuto, WhatCallsForItHereAndThereIsMasked) {
  const Result result = automatic(room(), {"--radius", "0.2", "--measure"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json effect = effect_of(result);
  EXPECT_EQ(effect["wanted"], true);
  EXPECT_EQ(effect["everywhere"], false);
  EXPECT_GT(effect["share_of_tiles"], 0.05);
  EXPECT_LT(effect["share_of_tiles"], 0.8);
  EXPECT_GT(effect["ms_everywhere"], 0);
  expect_same_as_run({"--radius", "0.2", "--only", "corner-mask"});
}

TEST_F(CliAuto, WhatCallsForItAlmostEverywhereIsNotMasked) {
  const Result result = automatic(corner(), {"--radius", "9", "--max-reach", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["everywhere"], true);
  EXPECT_EQ(effect_of(result)["ms_everywhere"], nullptr);
  expect_same_as_run({"--radius", "9", "--max-reach", "1"});
}

TEST_F(CliAuto, ASmallThingIsNotOverlooked) {
  // A ball of a few pixels on a wall.
  const Shot shot = perspective(400, 240);
  const Result result =
      automatic(nearest_of({tilted_plane(3, 0, 0), ball({0.3, 0.2, -2.97}, 0.03)}), {"--radius", "0.05"}, shot);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(effect_of(result)["wanted"], true);
}

TEST_F(CliAuto, APictureExplainsEachView) {
  const Result result = automatic(room(), {"--explain", path("why.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(slurp(path("why.png")).substr(1, 3), "PNG");
  const Result flat = automatic(tilted_plane(3, 0.6, 1), {"--explain", path("flat.png")});
  ASSERT_EQ(flat.status, 0) << flat.err;
  EXPECT_NE(slurp(path("flat.png")), slurp(path("why.png")));
  const Result told = gloam({"auto", path("frame.exr"), "-o", path("out.exr")});
  EXPECT_NE(told.out.find("nothing rises over any surface within the radius"), std::string::npos) << told.out;
}

TEST_F(CliAuto, WhatIsWrongIsSaidInOneLine) {
  const auto message = [&](const Arguments& more) {
    const Result result = automatic(room(), more);
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    return result.err;
  };
  EXPECT_NE(message({"--only", "corner-mask"}).find("--only"), std::string::npos);
  EXPECT_NE(message({"--explain", path("why.jpg")}).find("is a PNG"), std::string::npos);
  EXPECT_NE(message({"--explain", path("out.exr")}).find("PNG"), std::string::npos);
  EXPECT_NE(message({"--set", "radios=1"}).find("did you mean 'radius'"), std::string::npos);
  EXPECT_NE(message({"--preset", "best"}).find("no preset 'best'"), std::string::npos);
  const Result missing = gloam({"auto", path("nothing.exr"), "-o", path("out.exr")});
  EXPECT_EQ(missing.lines_of_error(), 1) << missing.err;
}

}  // namespace
}  // namespace gloam::test
