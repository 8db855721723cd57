// Recognition of planes from channel names alone.
#include "exr/channel_names.h"

#include <gtest/gtest.h>

#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam::channel_names_test {
namespace {

using namespace gloam;
using Names = std::vector<std::string>;

std::vector<FileChannel> single_part(const Names& names) {
  std::vector<FileChannel> channels;
  for (const std::string& name : names) channels.push_back({0, "", "", name, "float"});
  return channels;
}

Names channels_of(const NamedPlanes& named, const std::string& plane, const std::string& view = "") {
  Names names;
  for (const PlaneSource& source : named.planes)
    if (source.plane == plane && source.view == view)
      for (const ChannelSource& channel : source.channels) names.push_back(channel.name);
  return names;
}

Names found(const Names& names, const std::string& plane) {
  return channels_of(name_planes(single_part(names), {}), plane);
}

DeclaredConvention said_of(const Names& names, const std::string& plane) {
  for (const PlaneSource& source : name_planes(single_part(names), {}).planes)
    if (source.plane == plane) return source.said;
  ADD_FAILURE() << "no " << plane;
  return DeclaredConvention::nothing;
}

std::string error_of(const Names& names, const NameOptions& options, const Names& multi_view = {}) {
  try {
    name_planes(single_part(names), multi_view, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ChannelNames, BlenderMultilayer) {
  const Names file = {
      "View Layer.Combined.A", "View Layer.Combined.B", "View Layer.Combined.G", "View Layer.Combined.R",
      "View Layer.Depth.Z",    "View Layer.DiffCol.B",  "View Layer.DiffCol.G",  "View Layer.DiffCol.R",
      "View Layer.IndexOB.X",  "View Layer.Mist.Z",     "View Layer.Normal.X",   "View Layer.Normal.Y",
      "View Layer.Normal.Z",   "View Layer.Position.X", "View Layer.Position.Y", "View Layer.Position.Z",
      "View Layer.UV.U",       "View Layer.UV.V",       "View Layer.Vector.W",   "View Layer.Vector.X",
      "View Layer.Vector.Y",   "View Layer.Vector.Z",   "View Layer.AO.R",       "View Layer.AO.G",
      "View Layer.AO.B"};
  EXPECT_EQ(found(file, "depth"), Names{"View Layer.Depth.Z"});
  EXPECT_EQ(found(file, "normal"), (Names{"View Layer.Normal.X", "View Layer.Normal.Y", "View Layer.Normal.Z"}));
  EXPECT_EQ(found(file, "color"), (Names{"View Layer.Combined.R", "View Layer.Combined.G", "View Layer.Combined.B"}));
  EXPECT_EQ(found(file, "alpha"), Names{"View Layer.Combined.A"});
  EXPECT_EQ(found(file, "albedo").size(), 3u);
  EXPECT_EQ(found(file, "position").front(), "View Layer.Position.X");
  EXPECT_EQ(found(file, "motion"), (Names{"View Layer.Vector.X", "View Layer.Vector.Y"}));
  EXPECT_EQ(found(file, "ao"), Names{"View Layer.AO.R"});
}

TEST(ChannelNames, BlenderMotionPointsUp) {
  const auto named = name_planes(single_part({"L.Vector.X", "L.Vector.Y", "motion.X"}), {});
  ASSERT_EQ(named.planes.size(), 1u);
  EXPECT_EQ(named.planes[0].channels[0].scale, 1);
  EXPECT_EQ(named.planes[0].channels[1].scale, -1);
}

TEST(ChannelNames, WhatIsNotDepth) {
  for (const char* name : {"ViewLayer.Mist.Z", "ViewLayer.UV.U", "ViewLayer.IndexOB.X", "disparityL.x", "disparity.Z",
                           "ViewLayer.Position.Z", "N.Z", "volume_Z", "st.t", "CryptoObject00.r"})
    EXPECT_EQ(found({name, "st.s"}, "depth"), Names{}) << name;
}

struct Spelled {
  const char* plane;
  Names names;
};

class Spellings : public testing::TestWithParam<Spelled> {};

TEST_P(Spellings, AreFound) { EXPECT_EQ(found(GetParam().names, GetParam().plane), GetParam().names); }

INSTANTIATE_TEST_SUITE_P(
    All, Spellings,
    testing::Values(
        Spelled{"depth", {"Z"}}, Spelled{"depth", {"z"}}, Spelled{"depth", {"depth.V"}}, Spelled{"depth", {"depth"}},
        Spelled{"depth", {"depth.Z"}}, Spelled{"depth", {"depth.Y"}}, Spelled{"depth", {"dd.y"}},
        Spelled{"depth", {"dd.T"}}, Spelled{"depth", {"dd.y.T"}}, Spelled{"depth", {"distance.Y"}},
        Spelled{"depth", {"Pz"}}, Spelled{"depth", {"hitPz"}}, Spelled{"depth", {"ray:hitPz"}},
        Spelled{"depth", {"FinalImageWorldDepth.R"}}, Spelled{"depth", {"FinalImageMovieRenderQueue_WorldDepth.R"}},
        Spelled{"depth", {"RenderLayer.depth.z"}}, Spelled{"normal", {"N.X", "N.Y", "N.Z"}},
        Spelled{"normal", {"Nn.x", "Nn.y", "Nn.z"}}, Spelled{"normal", {"__Nworld.r", "__Nworld.g", "__Nworld.b"}},
        Spelled{"normal", {"nn.X", "nn.Y", "nn.Z"}},
        Spelled{"normal", {"FinalImageWorldNormal.R", "FinalImageWorldNormal.G", "FinalImageWorldNormal.B"}},
        Spelled{"normal", {"N.R", "N.G", "N.B"}}, Spelled{"position", {"P.X", "P.Y", "P.Z"}},
        Spelled{"position", {"__Pworld.r", "__Pworld.g", "__Pworld.b"}}, Spelled{"color", {"R", "G", "B"}},
        Spelled{"color", {"beauty.R", "beauty.G", "beauty.B"}}, Spelled{"color", {"C.R", "C.G", "C.B"}},
        Spelled{"albedo", {"diffuse_albedo.R", "diffuse_albedo.G", "diffuse_albedo.B"}},
        Spelled{"albedo", {"FinalImageBaseColor.R", "FinalImageBaseColor.G", "FinalImageBaseColor.B"}},
        Spelled{"ambient", {"ambient.R", "ambient.G", "ambient.B"}}, Spelled{"metallic", {"metallic"}},
        Spelled{"metallic", {"ViewLayer.Metalness.X"}}, Spelled{"roughness", {"ViewLayer.Roughness.X"}},
        Spelled{"roughness", {"roughness"}}, Spelled{"roughness", {"FinalImageRoughness.R"}},
        Spelled{"motion", {"FinalImageMovieRenderQueue_MotionVectors.R", "FinalImageMovieRenderQueue_MotionVectors.G"}},
        Spelled{"motion", {"motion.X", "motion.Y"}}, Spelled{"ao", {"AO"}}, Spelled{"ao", {"occlusion.R"}},
        Spelled{"ao_raw", {"AO_raw"}}, Spelled{"back_depth", {"backZ"}}, Spelled{"instance", {"instance"}},
        Spelled{"peel.00", {"peel.00.Z"}}, Spelled{"stochastic.07", {"stochastic.07.Z"}},
        Spelled{"peel_count", {"peel.count"}}, Spelled{"outline_count", {"outline.count"}}, Spelled{"mask", {"mask"}},
        Spelled{"bent_normal", {"bent.X", "bent.Y", "bent.Z"}}, Spelled{"cone", {"cone"}},
        Spelled{"reflectance", {"reflectance.R", "reflectance.G", "reflectance.B"}},
        Spelled{"reflection", {"reflection.R", "reflection.G", "reflection.B", "reflection.A"}},
        Spelled{"indirect", {"indirect.R", "indirect.G", "indirect.B"}},
        Spelled{"indirect_raw", {"indirect_raw.R", "indirect_raw.G", "indirect_raw.B"}},
        Spelled{"bounces", {"bounces.R", "bounces.G", "bounces.B"}},
        Spelled{"specular_occlusion", {"specular_occlusion"}}, Spelled{"contact", {"contact"}},
        Spelled{"environment", {"environment.R", "environment.G", "environment.B"}}, Spelled{"hit", {"hit.Z"}}));

/// Names of layers with red, green and blue, by the plane that they are.
TEST(ChannelNames, LightThatIsNotDarkened) {
  const std::map<std::string, Names> layers = {
      {"emission", {"ViewLayer.Emit", "emission", "VRaySelfIllumination", "selfIllum", "Emission", "emissive"}},
      {"backdrop", {"ViewLayer.Env", "backdrop", "background", "VRayBackground"}},
      {"volume", {"volume", "VRayAtmosphere", "atmosphere", "VolumeLighting", "ViewLayer.VolumeDir", "combinedvolume"}},
      {"transmission", {"transmission", "VRayRefraction", "refract", "Refractions", "glossytransmission"}},
      {"illumination", {"illumination", "diffuse_illumination"}},
      {"albedo", {"diffuse_reflectance"}}};
  for (const auto& [plane, names] : layers) {
    for (const std::string& layer : names) {
      const Names channels = {layer + ".R", layer + ".G", layer + ".B"};
      EXPECT_EQ(found(channels, plane), channels) << layer;
    }
  }
}

Names with_colours(const Names& layers) {
  Names channels;
  for (const std::string& layer : layers)
    for (const char* component : {".R", ".G", ".B"}) channels.push_back(layer + component);
  return channels;
}

/// Layers of one component, and of three, as V-Ray, Corona, Redshift, Octane for Blender and Unity call them.
TEST(ChannelNames, LayersOfRenderersWithoutAStandard) {
  const std::map<std::string, Names> single = {
      {"depth", {"VRayZDepth", "ZDepth", "CGeometry_ZDepth", "ViewLayer.OctZDepth", "Depth", "SceneDepth"}},
      {"metallic", {"VRayMetalness", "Metal"}},
      {"roughness", {"VRayRoughness"}}};
  const std::map<std::string, Names> triple = {
      {"normal",
       {"VRayNormals", "VRayBumpNormals", "CGeometry_NormalsShading", "CGeometry_NormalsGeometry", "BumpNormals",
        "Bump Normals", "ViewLayer.OctShadingNormal", "ViewLayer.OctSmoothNormal", "ViewLayer.OctGeoNormal"}},
      {"albedo", {"VRayDiffuseFilter", "DiffuseFilter", "CShading_Albedo"}},
      {"position", {"World Position", "WorldPosition", "CGeometry_WorldPosition", "ViewLayer.OctPosition"}},
      {"emission", {"CESSENTIAL_Emission"}}};
  for (const auto& [plane, layers] : single) {
    for (const std::string& layer : layers) {
      EXPECT_EQ(found({layer + ".R"}, plane), Names{layer + ".R"}) << layer;
      EXPECT_EQ(found({layer + ".Z"}, plane), Names{layer + ".Z"}) << layer;
    }
  }
  EXPECT_EQ(found({"VRayZDepth.red"}, "depth"), Names{"VRayZDepth.red"});
  for (const auto& [plane, layers] : triple) {
    for (const std::string& layer : layers) {
      const Names capitals = {layer + ".R", layer + ".G", layer + ".B"},
                  words = {layer + ".red", layer + ".green", layer + ".blue"};
      EXPECT_EQ(found(capitals, plane), capitals) << layer;
      EXPECT_EQ(found(words, plane), words) << layer;
    }
  }
  EXPECT_EQ(said_of({"VRayNormals.R", "VRayNormals.G", "VRayNormals.B"}, "normal"), DeclaredConvention::view_space);
  EXPECT_EQ(said_of({"VRayZDepth.Z"}, "depth"), DeclaredConvention::nothing) << "a grey is no planar distance";
  // What may be positions, normals or anything else is taken for nothing, nor is Redshift's position in the object's space.
  for (const char* layer : {"VRaySamplerInfo", "ObjectSpacePositions"})
    for (const char* plane : {"position", "normal", "color"})
      EXPECT_EQ(found(with_colours({layer}), plane), Names{}) << layer;
  // The shading normals come before those of the faces.
  EXPECT_EQ(found(with_colours({"CGeometry_NormalsGeometry", "CGeometry_NormalsShading"}), "normal"),
            with_colours({"CGeometry_NormalsShading"}));
}

TEST(ChannelNames, LayersThatAreAddedUp) {
  const Names volume = with_colours({"L.VolumeDir", "L.VolumeInd"}), light = with_colours({"L.DiffDir", "L.DiffInd"}),
              glass = with_colours({"L.TransDir", "L.TransInd", "L.TransCol"});
  EXPECT_EQ(found(volume, "volume"), volume);
  EXPECT_EQ(said_of(volume, "volume"), DeclaredConvention::sum_of_layers);
  EXPECT_EQ(found(glass, "transmission"), glass);
  EXPECT_EQ(said_of(glass, "transmission"), DeclaredConvention::sum_times_last);
  EXPECT_EQ(found(light, "illumination"), light);
  // Layers of two view layers are not added, nor some of those of a product.
  EXPECT_EQ(found(with_colours({"L.DiffDir", "M.DiffInd"}), "illumination"), Names{});
  EXPECT_EQ(found(with_colours({"L.TransDir", "L.TransCol"}), "transmission"), Names{});
  EXPECT_EQ(found(with_colours({"volume", "volume_direct", "volume_indirect"}), "volume"), with_colours({"volume"}));
  EXPECT_EQ(found(with_colours({"CryptoObject00", "L.CryptoMaterial00"}), "color"), Names{});
}

TEST(ChannelNames, EachPlaneIsFoundInTheChannelsThatAreWrittenForIt) {
  for (const PlaneKind& kind : plane_kinds()) EXPECT_EQ(found(kind.channels, kind.name), kind.channels) << kind.name;
}

TEST(ChannelNames, OwnNamesComeFirst) {
  EXPECT_EQ(found({"A.Depth.Z", "Z"}, "depth"), Names{"Z"});
  EXPECT_EQ(found({"A.AO.R", "AO", "occlusion.R"}, "ao"), Names{"AO"});
  EXPECT_EQ(
      found({"albedo.R", "albedo.G", "albedo.B", "diffuse_albedo.R", "diffuse_albedo.G", "diffuse_albedo.B"}, "albedo")
          .front(),
      "albedo.R");
}

TEST(ChannelNames, RayDistanceIsKnownByName) {
  EXPECT_EQ(said_of({"distance.Y"}, "depth"), DeclaredConvention::ray_distance);
  EXPECT_EQ(said_of({"dd.y"}, "depth"), DeclaredConvention::ray_distance);
  EXPECT_EQ(said_of({"any.T"}, "depth"), DeclaredConvention::ray_distance);
  EXPECT_EQ(said_of({"ViewLayer.Depth.Z"}, "depth"), DeclaredConvention::planar);
  EXPECT_EQ(said_of({"depth.V"}, "depth"), DeclaredConvention::nothing);
  EXPECT_EQ(said_of({"Z"}, "depth"), DeclaredConvention::nothing);
}

TEST(ChannelNames, MitsubaBeautyIsTheOnlyRgbaLayerLeft) {
  const Names file = {"my_image.A", "my_image.B", "my_image.G", "my_image.R", "dd.T", "nn.X", "nn.Y", "nn.Z"};
  EXPECT_EQ(found(file, "color"), (Names{"my_image.R", "my_image.G", "my_image.B"}));
  EXPECT_EQ(found(file, "alpha"), Names{"my_image.A"});
  // Without alpha it may be any light pass.
  EXPECT_EQ(found({"Emit.R", "Emit.G", "Emit.B"}, "color"), Names{});
  EXPECT_EQ(found({"crypto00.R", "crypto00.G", "crypto00.B", "crypto00.A"}, "color"), Names{});
}

TEST(ChannelNames, TieTakesTheFirstLayerAndSaysSo) {
  const auto named = name_planes(single_part({"Back.Depth.Z", "Front.Depth.Z", "Front.Normal.X", "Front.Normal.Y",
                                              "Front.Normal.Z", "Back.Normal.X", "Back.Normal.Y", "Back.Normal.Z"}),
                                 {});
  EXPECT_EQ(channels_of(named, "depth"), Names{"Back.Depth.Z"});
  EXPECT_EQ(channels_of(named, "normal").front(), "Back.Normal.X") << "normals of the layer that the depth is from";
  ASSERT_EQ(named.assumed.at("depth").size(), 1u);
  EXPECT_NE(named.assumed.at("depth")[0].find("Front.Depth.Z"), std::string::npos);
}

TEST(ChannelNames, StandardMultiView) {
  const auto named = name_planes(single_part({"Z", "R", "G", "B", "left.Z", "left.R", "left.G", "left.B", "N.right.X",
                                              "N.right.Y", "N.right.Z", "N.left.X", "N.left.Y", "N.left.Z"}),
                                 {"right", "left"});
  EXPECT_EQ(named.views, (Names{"right", "left"}));
  EXPECT_EQ(channels_of(named, "depth", "right"), Names{"Z"});
  EXPECT_EQ(channels_of(named, "depth", "left"), Names{"left.Z"});
  EXPECT_EQ(channels_of(named, "normal", "left").front(), "N.left.X");
  EXPECT_EQ(channels_of(named, "color", "right").front(), "R");
}

TEST(ChannelNames, ViewsComeInTheOrderAskedFor) {
  const auto names = single_part({"Z", "left.Z"});
  const std::vector<std::string> in_file = {"right", "left"};
  EXPECT_EQ(name_planes(names, in_file, {{"left", "right"}, {}}).views, (Names{"left", "right"}));
  EXPECT_EQ(name_planes(names, in_file, {{"right", "left"}, {}}).views, (Names{"right", "left"}));
  const auto twice = name_planes(names, in_file, {{"left", "left"}, {}});
  EXPECT_EQ(twice.views, Names{"left"});
  EXPECT_EQ(channels_of(twice, "depth", "left"), Names{"left.Z"});
}

TEST(ChannelNames, BlenderMultiViewAndOneElement) {
  const auto both = name_planes(single_part({"VL.Depth.left.Z", "VL.Depth.right.Z"}), {"left", "right"});
  EXPECT_EQ(channels_of(both, "depth", "left"), Names{"VL.Depth.left.Z"});
  EXPECT_EQ(channels_of(both, "depth", "right"), Names{"VL.Depth.right.Z"});
  const auto one = name_planes(single_part({"VL.Depth.Z"}), {"right"});
  EXPECT_EQ(one.views, Names{"right"});
  EXPECT_EQ(channels_of(one, "depth", "right"), Names{"VL.Depth.Z"});
}

TEST(ChannelNames, ViewThatIsOnlyListedIsNoView) {
  EXPECT_EQ(name_planes(single_part({"AO"}), {"left", "right"}).views, Names{"left"});
  const auto right = name_planes(single_part({"AO"}), {"left", "right"}, {{"right"}, {}});
  EXPECT_EQ(channels_of(right, "ao", "right"), Names{"AO"});
  EXPECT_FALSE(right.assumed.at("").empty());
}

TEST(ChannelNames, PartsWithViewsAndSharedParts) {
  const std::vector<FileChannel> file = {
      {0, "right", "rgba_right", "R", "half"},  {0, "right", "rgba_right", "G", "half"},
      {0, "right", "rgba_right", "B", "half"},  {1, "left", "depth_left", "Z", "half"},
      {2, "right", "depth_right", "Z", "half"}, {3, "", "mask", "mask", "half"}};
  const auto named = name_planes(file, {});
  EXPECT_EQ(named.views, (Names{"right", "left"}));
  EXPECT_EQ(channels_of(named, "depth", "left").size(), 1u);
  EXPECT_EQ(channels_of(named, "mask", "left"), Names{"mask"});
  EXPECT_EQ(channels_of(named, "mask", "right"), Names{"mask"});
  EXPECT_EQ(channels_of(named, "color", "left"), Names{});
}

TEST(ChannelNames, NameOfAPartSpeaksForItsPlainChannels) {
  std::vector<FileChannel> file;
  for (const char* c : {"B", "G", "R"}) file.push_back({0, "", "albedo", c, "half"});
  for (const char* c : {"B", "G", "R"}) file.push_back({1, "", "diffuse_direct", c, "half"});
  for (const char* c : {"A", "B", "G", "R", "Z"}) file.push_back({2, "", "rgba", c, "half"});
  file.push_back({3, "", "Mist", "Z", "half"});
  const auto named = name_planes(file, {});
  auto part = [&](const std::string& plane) {
    for (const PlaneSource& source : named.planes)
      if (source.plane == plane) return source.channels.front().part;
    return -1;
  };
  EXPECT_EQ(part("albedo"), 0);
  EXPECT_EQ(part("color"), 2);
  EXPECT_EQ(part("alpha"), 2);
  EXPECT_EQ(part("depth"), 2);
}

TEST(ChannelNames, OverrideByChannelChannelsAndLayer) {
  const Names file = {"Z", "My Layer.Deep", "n1", "n2", "n3", "Foo.N.X", "Foo.N.Y", "Foo.N.Z"};
  auto chosen = [&](const std::string& plane, const std::string& text) {
    return channels_of(name_planes(single_part(file), {}, {{}, {{plane, text}}}), plane);
  };
  EXPECT_EQ(chosen("depth", "My Layer.Deep"), Names{"My Layer.Deep"});
  EXPECT_EQ(chosen("depth", "my layer.deep"), Names{"My Layer.Deep"});
  EXPECT_EQ(chosen("normal", "n3,n1,n2"), (Names{"n3", "n1", "n2"}));
  EXPECT_EQ(chosen("normal", "Foo.N"), (Names{"Foo.N.X", "Foo.N.Y", "Foo.N.Z"}));
}

TEST(ChannelNames, NoneLeavesAPlaneOutInEveryView) {
  const Names file = {"left.Z",          "right.Z",          "left.GlossCol.R",  "left.GlossCol.G",
                      "left.GlossCol.B", "right.GlossCol.R", "right.GlossCol.G", "right.GlossCol.B"};
  const std::vector<std::string> views = {"left", "right"};
  const auto all = name_planes(single_part(file), views);
  const auto rest = name_planes(single_part(file), views, {{}, {{"reflectance", "none"}}});
  for (const std::string& view : views) {
    EXPECT_EQ(channels_of(all, "reflectance", view).size(), 3u);
    EXPECT_EQ(channels_of(rest, "reflectance", view), Names{});
    EXPECT_EQ(channels_of(rest, "depth", view).size(), 1u);
  }
}

TEST(ChannelNames, OverrideAppliesToEveryView) {
  const auto named =
      name_planes(single_part({"L.Far.left.Z", "L.Far.right.Z"}), {"left", "right"}, {{}, {{"depth", "L.Far.Z"}}});
  EXPECT_EQ(channels_of(named, "depth", "left"), Names{"L.Far.left.Z"});
  EXPECT_EQ(channels_of(named, "depth", "right"), Names{"L.Far.right.Z"});
}

TEST(ChannelNames, WrongNamesAreErrorsWithSuggestions) {
  EXPECT_NE(error_of({"Layer.Z"}, {{}, {{"depht", "Layer.Z"}}}).find("did you mean 'depth'"), std::string::npos);
  EXPECT_NE(error_of({"Layer.Z"}, {{}, {{"depth", "Layr.Z"}}}).find("did you mean 'Layer.Z'"), std::string::npos);
  EXPECT_NE(error_of({"a.X", "a.Y"}, {{}, {{"normal", "a.X,a.Y"}}}).find("3 component"), std::string::npos);
  EXPECT_NE(error_of({"Z"}, {{"left"}, {}}).find("names no views"), std::string::npos);
  EXPECT_NE(error_of({"Z"}, {{"rihgt"}, {}}, {"left", "right"}).find("no such view (did you mean 'right'?); the"),
            std::string::npos);
}

TEST(ChannelNames, TiesBetweenPartsNameTheParts) {
  const auto sentence = [](const char* first, const char* second) {
    const auto named = name_planes({{0, "", first, "Z", "float"}, {1, "", second, "Z", "float"}}, {});
    return named.assumed.contains("depth") ? named.assumed.at("depth").front() : "";
  };
  EXPECT_EQ(sentence("a", "b"), "depth: 'Z' of part 'a' taken, not 'Z' of part 'b' (--plane depth=b chooses)");
  EXPECT_EQ(sentence("", ""), "depth: 'Z' of part 0 taken, not 'Z' of part 1 (--plane depth=1:Z chooses)");
  const auto chosen = name_planes({{0, "", "a", "Z", "float"}, {1, "", "b", "Z", "float"}}, {}, {{}, {{"depth", "b"}}});
  EXPECT_EQ(chosen.planes.at(0).channels.at(0).part, 1) << "as the sentence says";
}

TEST(ChannelNames, AViewThatNoChannelNamesIsSaid) {
  const auto named = name_planes(single_part({"Z"}), {"left", "right"});
  EXPECT_TRUE(named.view_is_assumed);
  EXPECT_EQ(named.views, Names{"left"});
  ASSERT_TRUE(named.assumed.contains(""));
  EXPECT_NE(named.assumed.at("").front().find("all are taken for 'left'"), std::string::npos);
  for (const char* view : {"left", "right"}) {
    const auto told = name_planes(single_part({"Z"}), {"left", "right"}, {{view}, {}});
    EXPECT_FALSE(told.view_is_assumed);
    EXPECT_EQ(told.assumed.at("").front(), fmt::format("no channel names a view: all are taken for '{}'", view));
  }
  EXPECT_FALSE(name_planes(single_part({"Z"}), {"left"}).view_is_assumed) << "one view leaves no choice";
  EXPECT_FALSE(name_planes(single_part({"Z", "right.Z"}), {"left", "right"}).view_is_assumed);
}

TEST(ChannelNames, NothingKnownIsNoError) {
  const auto named = name_planes(single_part({"G"}), {});
  EXPECT_TRUE(named.planes.empty());
  EXPECT_EQ(named.views, Names{""});
}

}  // namespace

}  // namespace gloam::channel_names_test
