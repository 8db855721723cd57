// The whole picture of a frame: every term against its closed form, what is not counted twice, and what stays as it is.
#include "gloam/composition.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "unit/message_of.h"

namespace gloam::test::composition_test {
namespace {

using Names = std::vector<std::string>;
using Colour = std::array<float, 3>;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Plane even(const std::string& name, const std::vector<float>& values, const Layout& layout = Layout(5, 3)) {
  Plane plane{name, {}};
  for (const float value : values) {
    Channel& channel = plane.channels.emplace_back(layout, nan);  // reading padding would be noticed
    for (int y = 0; y < layout.height; ++y) std::fill_n(channel.row(y), layout.width, value);
  }
  return plane;
}

using Planes = std::map<std::string, std::vector<float>>;

Frame frame_of(const Planes& planes, const std::string& name = "") {
  Frame frame;
  frame.window = frame.display = {0, 0, 5, 3};
  frame.views.emplace_back().name = name;
  for (const auto& [plane, values] : planes) frame.views[0].planes[plane] = even(plane, values);
  return frame;
}

/// A colour that is direct light of 0.5, 0.4, 0.3 and ambient light of 0.1, 0.2, 0.3.
const Planes lit = {
    {"color", {0.6f, 0.6f, 0.6f}}, {"ambient", {0.1f, 0.2f, 0.3f}}, {"albedo", {0.8f, 0.5f, 0.25f}}, {"depth", {2}}};

Planes with(Planes planes, const Planes& more) {
  for (const auto& [plane, values] : more) planes[plane] = values;
  return planes;
}
Planes without(Planes planes, const std::string& plane) {
  planes.erase(plane);
  return planes;
}

/// The colour of the picture, after a check that all pixels have it.
Colour picture(const Planes& frame, const Planes& computed, const ComposeOptions& options = {}) {
  Frame colour = frame_of(frame);
  const Frame parts = frame_of(computed);
  compose(colour, parts, options);
  Colour result{};
  for (size_t i = 0; i < 3; ++i) {
    const Channel& channel = colour.views[0].planes.at("color").channels[i];
    result[i] = channel.at(0, 0);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) EXPECT_EQ(channel.at(x, y), result[i]) << x << " " << y;
  }
  return result;
}

void expect_colour(const Colour& is, const Colour& expected) {
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], expected[i], 1e-6) << "component " << i;
}

/// Why a part is not used; "used" if it is.
std::string why_not(const Names& frame, const Names& computed, const std::string& part,
                    const ComposeOptions& options = {}) {
  const Composition composition = composition_of(frame, computed, options);
  for (const ComposedPart& of : composition.parts) {
    if (of.plane == part) return of.is_used ? "used" : of.how;
  }
  return "not computed";
}

const Names all_of_frame = {"albedo", "ambient", "color", "depth"};

TEST(Composition, AoDarkensAmbientLightAlone) {
  expect_colour(picture(lit, {{"ao", {0.25f}}}), {0.5f + 0.025f, 0.4f + 0.05f, 0.3f + 0.075f});
  expect_colour(picture(lit, {{"ao", {0}}}), {0.5f, 0.4f, 0.3f});
}

TEST(Composition, BouncesTakeThePlaceOfAo) {
  expect_colour(picture(lit, {{"ao", {0}}, {"bounces", {0.5f, 0.75f, 0.25f}}}),
                {0.5f + 0.05f, 0.4f + 0.15f, 0.3f + 0.075f});
  EXPECT_NE(why_not(all_of_frame, {"ao", "bounces"}, "ao").find("'bounces' holds"), std::string::npos);
  EXPECT_EQ(why_not(all_of_frame, {"ao", "bounces"}, "bounces"), "used");
}

TEST(Composition, IndirectIsTimesAlbedoAndKeepsBouncesOut) {
  expect_colour(picture(lit, {{"indirect", {1, 0.5f, 2}}}), {0.6f + 0.8f, 0.6f + 0.25f, 0.6f + 0.5f});
  // Light that is reflected once is counted once: of `ao` and `bounces` it is `ao`.
  expect_colour(picture(lit, {{"ao", {0.5f}}, {"bounces", {1, 1, 1}}, {"indirect", {1, 0.5f, 2}}}),
                {0.55f + 0.8f, 0.5f + 0.25f, 0.45f + 0.5f});
  EXPECT_NE(why_not(all_of_frame, {"bounces", "indirect"}, "bounces").find("'indirect' holds"), std::string::npos);
}

TEST(Composition, MetalReflectsNothingDiffusely) {
  const Planes metal = with(lit, {{"metallic", {0.75f}}});
  expect_colour(picture(metal, {{"indirect", {1, 1, 1}}}), {0.6f + 0.2f, 0.6f + 0.125f, 0.6f + 0.0625f});
}

TEST(Composition, ReflectionIsAdded) {
  expect_colour(picture(lit, {{"reflection", {0.1f, 0.2f, 0.3f, 0.5f}}}), {0.7f, 0.8f, 0.9f});
}

TEST(Composition, EnvironmentTakesThePlaceOfAmbientLight) {
  expect_colour(picture(lit, {{"ao", {0.1f}}, {"bounces", {0.1f, 0.1f, 0.1f}}, {"environment", {1, 2, 4}}}),
                {0.5f + 0.8f, 0.4f + 1.0f, 0.3f + 1.0f});
  EXPECT_NE(why_not(all_of_frame, {"ao", "environment"}, "ao").find("'environment'"), std::string::npos);
}

TEST(Composition, ContactDarkensDirectLightWhereColourHasNoShadows) {
  ComposeOptions unshadowed;
  unshadowed.holds.shadows = false;
  expect_colour(picture(lit, {{"contact", {0.5f}}}, unshadowed), {0.35f, 0.4f, 0.45f});
  expect_colour(picture(lit, {{"contact", {0}}, {"ao", {0}}}, unshadowed), {0, 0, 0});
  expect_colour(picture(lit, {{"contact", {0.5f}}}), {0.6f, 0.6f, 0.6f});
  EXPECT_EQ(why_not(all_of_frame, {"contact"}, "contact"), "the colour holds shadows already");
  EXPECT_NE(why_not({"color", "albedo"}, {"contact"}, "contact", unshadowed).find("--ambient"), std::string::npos);
}

TEST(Composition, AllTermsTogether) {
  ComposeOptions unshadowed;
  unshadowed.holds.shadows = false;
  const Planes parts = {
      {"ao", {0.5f}}, {"indirect", {1, 1, 1}}, {"reflection", {0.25f, 0.5f, 0.75f, 1}}, {"contact", {0.5f}}};
  for (size_t i = 0; i < 3; ++i) {
    const float ambient = lit.at("ambient")[i], expected = 0.6f - 0.5f * ambient + lit.at("albedo")[i] +
                                                           parts.at("reflection")[i] - 0.5f * (0.6f - ambient);
    EXPECT_NEAR(picture(lit, parts, unshadowed)[i], expected, 1e-6);
  }
}

TEST(Composition, WithoutAmbientAnEvenSkyOrAllOfTheColour) {
  const Planes plain = without(lit, "ambient");
  expect_colour(picture(plain, {{"ao", {0.5f}}}), {0.3f, 0.3f, 0.3f});
  const Composition of_colour = composition_of({"color", "albedo"}, {"ao"}, {});
  ASSERT_EQ(of_colour.notes.size(), 1u);
  EXPECT_NE(of_colour.notes[0].find("--ambient R,G,B"), std::string::npos);
  ComposeOptions sky;
  sky.ambient = {0.5, 0.25, 1};
  expect_colour(picture(plain, {{"ao", {0.5f}}}, sky), {0.6f - 0.2f, 0.6f - 0.0625f, 0.6f - 0.125f});
  EXPECT_TRUE(composition_of({"color", "albedo"}, {"ao"}, sky).notes.empty());
  // No more of the colour than all of it is ambient light.
  sky.ambient = {100, 100, 100};
  expect_colour(picture(plain, {{"ao", {0.25f}}}, sky), {0.15f, 0.15f, 0.15f});
  EXPECT_NE(message_of([&] { composition_of({"color"}, {"ao"}, sky); }).find("--ambient 100,100,100"),
            std::string::npos);
}

/// Of the 0.6 of colour 0.25 is light that stays.
const Planes with_light = with(lit, {{"emission", {0.125f, 0.125f, 0.125f}},
                                     {"volume", {0.0625f, 0.0625f, 0.0625f}},
                                     {"backdrop", {0.03125f, 0.03125f, 0.03125f}},
                                     {"transmission", {0.03125f, 0.03125f, 0.03125f}}});

TEST(Composition, LightThatIsNotDarkened) {
  const Planes plain = without(with_light, "ambient");
  expect_colour(picture(plain, {{"ao", {0.5f}}}), {0.425f, 0.425f, 0.425f});
  expect_colour(picture(plain, {{"ao", {0}}}), {0.25f, 0.25f, 0.25f});
  // Ambient light is at most what is left; contact shadows are of what is left then.
  expect_colour(picture(with(with_light, {{"ambient", {9, 0.2f, 0.3f}}}), {{"ao", {0.5f}}}), {0.425f, 0.5f, 0.45f});
  ComposeOptions unshadowed;
  unshadowed.holds.shadows = false;
  expect_colour(picture(with_light, {{"contact", {0}}}, unshadowed), {0.25f + 0.1f, 0.25f + 0.2f, 0.25f + 0.3f});
  // Light of its own that is all of the colour, or more by noise: the bits stay.
  EXPECT_EQ(picture(with(plain, {{"emission", {0.6f, 0.7f, 0.6f}}}), {{"ao", {0.5f}}}), (Colour{0.6f, 0.6f, 0.6f}));
  const Composition composition =
      composition_of({"color", "emission", "volume"}, {"ao"}, {.names_in_file = {{"emission", "L.Emit"}}});
  EXPECT_EQ(composition.untouched, (Names{"emission", "volume"}));
  ASSERT_EQ(composition.notes.size(), 2u);
  EXPECT_NE(composition.notes[0].find("all of its colour but emission and volume"), std::string::npos);
  EXPECT_NE(composition.notes[1].find("emission (L.Emit) and volume are not darkened"), std::string::npos);
  EXPECT_TRUE(composition_of({"ambient", "color", "emission"}, {"reflection"}, {}).notes.empty());
}

TEST(Composition, IlluminationTimesAlbedoIsDarkened) {
  const Planes lights = with(without(with_light, "ambient"), {{"illumination", {0.25f, 0.5f, 4}}});
  expect_colour(picture(lights, {{"ao", {0.5f}}}), {0.6f - 0.1f, 0.6f - 0.125f, 0.6f - 0.175f});
  // It holds direct light as well.
  ComposeOptions unshadowed;
  unshadowed.holds.shadows = false;
  for (const char* part : {"contact", "environment"})
    EXPECT_NE(why_not({"albedo", "color", "illumination"}, {part}, part, unshadowed).find("--ambient"),
              std::string::npos);
  EXPECT_EQ(composition_of({"color", "illumination"}, {"ao"}, {}).ambient, Composition::Ambient::colour);
  EXPECT_EQ(composition_of({"albedo", "color", "illumination"}, {"ao"}, {}).ambient,
            Composition::Ambient::illumination);
  EXPECT_EQ(composition_of({"albedo", "ambient", "color", "illumination"}, {"ao"}, {}).ambient,
            Composition::Ambient::plane);
}

TEST(Composition, WhatTheColourHoldsIsNotAdded) {
  const Planes parts = {{"ao", {0.5f}},          {"bounces", {1, 1, 1}},
                        {"indirect", {1, 1, 1}}, {"reflection", {1, 1, 1, 1}},
                        {"contact", {0}},        {"environment", {3, 3, 3}}};
  const ComposeOptions all{parse_color_holds("ambient,shadows,ao,indirect,reflection", "test")};
  const Frame before = frame_of(lit);
  Frame after = frame_of(lit);
  const Composition composition = compose(after, frame_of(parts), all);
  EXPECT_EQ(composition.parts.size(), parts.size());
  for (const ComposedPart& part : composition.parts) EXPECT_FALSE(part.is_used) << part.plane;
  expect_colour(picture(lit, parts, all), {0.6f, 0.6f, 0.6f});
}

TEST(Composition, AmbientLightThatTheColourLacksIsAdded) {
  const ComposeOptions direct{parse_color_holds("shadows", "test")};
  expect_colour(picture(lit, {{"ao", {0.5f}}}, direct), {0.65f, 0.7f, 0.75f});
  expect_colour(picture(lit, {{"reflection", {0, 0, 0, 0}}}, direct), {0.7f, 0.8f, 0.9f});
  expect_colour(picture(lit, {{"environment", {1, 1, 1}}}, direct), {1.4f, 1.1f, 0.85f});
  // Its light of surfaces around holds no ambient light, so what reflects ambient light has its place.
  EXPECT_EQ(why_not(all_of_frame, {"bounces", "indirect"}, "bounces", direct), "used");
  EXPECT_NE(why_not({"color"}, {"ao"}, "ao", direct).find("no ambient light"), std::string::npos);
}

TEST(Composition, WithoutAlbedoLightFallsAway) {
  const Planes plain = without(lit, "albedo");
  expect_colour(picture(plain, {{"indirect", {1, 1, 1}}, {"environment", {1, 1, 1}}}), {0.6f, 0.6f, 0.6f});
  for (const char* part : {"indirect", "environment"})
    EXPECT_EQ(why_not({"ambient", "color", "depth"}, {part}, part), "the frame has no 'albedo'");
}

TEST(Composition, KeepsBitsOfBackgroundAndOfWhatNothingChanges) {
  Frame frame = frame_of(lit);
  View& view = frame.views[0];
  const Colour odd = {-0.0f, nan, inf};
  for (int x = 0; x < 5; ++x) {
    view.planes.at("depth").channels[0].at(x, 0) = inf;
    for (size_t i = 0; i < 3; ++i) view.planes.at("color").channels[i].at(x, 1) = odd[i];
  }
  const Frame parts = frame_of({{"ao", {0.5f}}, {"indirect", {1, 1, 1}}});
  const Plane before = view.planes.at("color").clone();
  compose(frame, parts, {});
  const Plane& after = view.planes.at("color");
  for (size_t i = 0; i < 3; ++i)
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(std::bit_cast<uint32_t>(after.channels[i].at(x, 0)),
                std::bit_cast<uint32_t>(before.channels[i].at(x, 0)));
      EXPECT_NE(after.channels[i].at(x, 2), before.channels[i].at(x, 2));
    }
  EXPECT_TRUE(std::isnan(after.channels[1].at(0, 1)));
  EXPECT_EQ(after.channels[2].at(0, 1), inf);
  Frame same = frame_of(lit);
  for (size_t i = 0; i < 3; ++i) same.views[0].planes.at("color").channels[i].at(0, 0) = odd[i];
  const Plane kept = same.views[0].planes.at("color").clone();
  compose(same, frame_of({{"ao", {1}}, {"indirect", {0, 0, 0}}, {"reflection", {0, 0, 0, 1}}}), {});
  for (size_t i = 0; i < 3; ++i)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(std::bit_cast<uint32_t>(same.views[0].planes.at("color").channels[i].at(x, 0)),
                std::bit_cast<uint32_t>(kept.channels[i].at(x, 0)));
}

TEST(Composition, OfTwoViewsEachHasItsOwn) {
  Frame frame = frame_of(lit, "left"), parts = frame_of({{"reflection", {1, 1, 1, 1}}}, "left");
  Frame other = frame_of(with(lit, {{"color", {2, 2, 2}}}), "right"),
        other_parts = frame_of({{"reflection", {5, 5, 5, 1}}}, "right");
  frame.views.push_back(std::move(other.views[0]));
  parts.views.insert(parts.views.begin(), std::move(other_parts.views[0]));
  compose(frame, parts, {});
  EXPECT_NEAR(frame.view("left").find("color")->channels[0].at(0, 0), 1.6f, 1e-6);
  EXPECT_NEAR(frame.view("right").find("color")->channels[0].at(0, 0), 7, 1e-6);
}

TEST(Composition, RefusesOtherSizesAndFramesWithoutColour) {
  Frame frame = frame_of(lit), parts = frame_of({});
  parts.views[0].planes["ao"] = even("ao", {0.5f}, Layout(4, 3));
  EXPECT_EQ(message_of([&] { compose(frame, parts, {}); }), "color is 5 x 3, and ao 4 x 3");
  EXPECT_NE(message_of([] { composition_of({"depth"}, {"ao"}, {}); }).find("no 'color'"), std::string::npos);
}

TEST(Composition, EveryPartAndPlaneIsAKnownKind) {
  for (const Names& names : {part_planes(), planes_to_compose()})
    for (const std::string& name : names) EXPECT_FALSE(plane_kind(name).help.empty()) << name;
}

TEST(ColorHolds, IsAList) {
  EXPECT_EQ(in_words(ColorHolds()), "ambient,shadows");
  EXPECT_EQ(parse_color_holds("shadows, ambient", "test"), ColorHolds());
  for (const char* text : {"none", "ambient", "ambient,shadows,ao,indirect,reflection", "indirect"})
    EXPECT_EQ(in_words(parse_color_holds(text, "test")), text);
  EXPECT_NE(message_of([] { parse_color_holds("ambiant", "--color-holds"); }).find("did you mean 'ambient'"),
            std::string::npos);
  EXPECT_NE(message_of([] { parse_color_holds("ambient,,ao", "--color-holds"); }).find("'' is not known"),
            std::string::npos);
  EXPECT_NE(message_of([] { parse_color_holds("ao", "--color-holds"); }).find("write ambient too"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::composition_test
