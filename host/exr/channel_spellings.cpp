#include "exr/channel_spellings.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/words.h"
#include "exr/channel_text.h"
#include "gloam/planes.h"

namespace gloam::channel_names {
namespace {

constexpr const char* xyz = "x,y,z|r,g,b|red,green,blue";  // Nuke: red, green, blue
constexpr const char* rgb = "r,g,b|x,y,z|red,green,blue";
constexpr const char* one = "z|v|r|y|x|a|depth|red";

/// What others call the planes, and how gloam does where another way of writing its own name (planes.h) is taken for it too, or where
/// that name alone, in any layer, is not enough.
std::vector<Spelling> known_spellings() {
  using enum DeclaredConvention;
  return {
      // Depth. gloam and OpenEXR: Z. Blender: Depth.Z, file output depth.V. RenderMan: z. Karma: Pz, hitPz, depth.
      // Mitsuba 2: the name that the user gave ("dd.y", "depth.Y"), Mitsuba 3: <name>.T, both ray distances.
      {"depth", "", "z", own},
      {"depth", "depth", "z", renderer, planar},
      {"depth", "depth", one, renderer},
      {"depth", "z", one, renderer},
      {"depth", "zdepth", one, renderer},
      {"depth", "vrayzdepth", one, renderer},  // V-Ray, Corona: a grey between two distances
      {"depth", "cgeometryzdepth", one, renderer},
      {"depth", "octzdepth", one, renderer},  // Octane for Blender
      {"depth", "depthz", one, renderer},
      {"depth", "worlddepth", one, renderer},
      {"depth", "scenedepth", one, renderer},
      {"depth", "depthsensor", one, generic},  // Habitat
      {"depth", "depthpass", one, generic},
      {"depth", "zpass", one, generic},
      {"depth", "pz", one, renderer},
      {"depth", "hitpz", one, renderer},
      {"depth", "rayhitpz", one, renderer},
      {"depth", "cameradepth", one, generic},
      {"depth", "lineardepth", one, generic},
      {"depth", "depth", "t", renderer, ray_distance},
      {"depth", "dd", "y|t", renderer, ray_distance},
      {"depth", "y", "t", renderer, ray_distance},
      {"depth", "*", "t", last_resort, ray_distance},
      {"depth", "distance", "y|t|z|v|r|x", generic, ray_distance},
      {"depth", "raydistance", "y|t|z|v|r|x", generic, ray_distance},
      {"depth", "*", "depth|pz|hitpz|ray:hitpz|zdepth", generic},
      {"depth", "*", "distance", last_resort, ray_distance},

      // Normals. Blender: Normal. Arnold, Karma: N. RenderMan: Nn, __Nworld. Mitsuba: the user's name ("nn").
      {"normal", "n", "r,g,b|red,green,blue", renderer},
      {"normal", "normal", xyz, renderer},
      {"normal", "normals", xyz, renderer},
      {"normal", "nworld", xyz, renderer, world_space},
      {"normal", "nn", xyz, renderer},
      {"normal", "worldnormal", xyz, renderer, world_space},
      {"normal", "worldnormals", xyz, renderer, world_space},
      {"normal", "normalworld", xyz, renderer, world_space},
      {"normal", "shnormal", xyz, renderer},
      {"normal", "shadingnormal", xyz, renderer},
      {"normal", "smoothnormal", xyz, generic},
      {"normal", "vraynormals", xyz, renderer, view_space},
      {"normal", "cgeometrynormalsshading", xyz, renderer},
      {"normal", "octshadingnormal", xyz, renderer},
      {"normal", "octsmoothnormal", xyz, generic},
      {"normal", "bumpnormals", xyz, generic},  // Redshift
      {"normal", "vraybumpnormals", xyz, generic},
      {"normal", "hitn", xyz, renderer},
      {"normal", "rayhitn", xyz, renderer},
      {"normal", "ns", xyz, generic},
      {"normal", "cameranormal", xyz, generic, view_space},
      {"normal", "viewnormal", xyz, generic, view_space},
      {"normal", "normalcamera", xyz, generic, view_space},
      {"normal", "neye", xyz, generic, view_space},
      {"normal", "ncam", xyz, generic, view_space},
      {"normal", "geonormal", xyz, last_resort},
      {"normal", "cgeometrynormalsgeometry", xyz, last_resort},
      {"normal", "octgeonormal", xyz, last_resort},
      {"normal", "ng", xyz, last_resort},
      {"normal", "ngn", xyz, last_resort},
      {"normal", "hitng", xyz, last_resort},

      // The finished picture. Blender: Combined, single-layer files R G B. Unreal: FinalImage or no layer at all.
      {"color", "", "r,g,b", own},
      {"color", "combined", rgb, renderer},
      {"color", "beauty", rgb, renderer},
      {"color", "rgba", rgb, renderer},
      {"color", "rgb", rgb, renderer},
      {"color", "finalimage", rgb, renderer},
      {"color", "image", rgb, generic},
      {"color", "c", rgb, renderer},
      {"color", "ci", rgb, renderer},
      {"color", "color", rgb, generic},
      {"color", "colors", rgb, generic},
      {"color", "colorsensor", rgb, generic},
      {"color", "main", rgb, generic},
      {"alpha", "", "a", own},
      {"alpha", "combined", "a", renderer},
      {"alpha", "beauty", "a", renderer},
      {"alpha", "rgba", "a", renderer},
      {"alpha", "finalimage", "a", renderer},
      {"alpha", "image", "a", generic},
      {"alpha", "c", "a", renderer},
      {"alpha", "ci", "a", renderer},
      {"alpha", "color", "a", generic},
      {"alpha", "colorsensor", "a", generic},
      {"alpha", "main", "a", generic},
      {"alpha", "alpha", "a|r|v|x|y|z", generic},
      {"alpha", "*", "alpha", generic},

      // Material.
      {"albedo", "albedo", rgb, own},
      {"albedo", "diffusealbedo", rgb, renderer},
      {"albedo", "diffusereflectance", rgb, renderer},
      {"albedo", "diffcol", rgb, renderer},
      {"albedo", "basecolor", rgb, renderer},
      {"albedo", "basecolour", rgb, renderer},
      {"albedo", "diffusefilter", rgb, renderer},  // Redshift, V-Ray for Maya
      {"albedo", "vraydiffusefilter", rgb, renderer},
      {"albedo", "cshadingalbedo", rgb, renderer},
      {"albedo", "diffusecolor", rgb, generic},
      {"albedo", "rawalbedo", rgb, generic},
      {"albedo", "denoisealbedo", rgb, last_resort},
      {"albedo", "denoisingalbedo", rgb, last_resort},
      {"ambient", "ambient", rgb, own},

      // Light that occlusion does not darken, and diffuse light that it does. Blender divides by the colour: DiffDir, TransInd.
      {"emission", "emission", rgb, own},
      {"emission", "emit", rgb, renderer},
      {"emission", "emissive", rgb, renderer},
      {"emission", "directemission", rgb, renderer},
      {"emission", "vrayselfillumination", rgb, renderer},
      {"emission", "cessentialemission", rgb, renderer},
      {"emission", "selfillumination", rgb, renderer},
      {"emission", "selfillum", rgb, renderer},
      {"backdrop", "backdrop", rgb, own},
      {"backdrop", "background", rgb, renderer},
      {"backdrop", "env", rgb, renderer},
      {"backdrop", "vraybackground", rgb, renderer},
      {"volume", "volume", rgb, own},
      {"volume", "volumedir+volumeind", rgb, renderer},
      {"volume", "volumelighting+volumefogemission", rgb, renderer},
      {"volume", "volumedirect+volumeindirect", rgb, renderer},
      {"volume", "vrayatmosphere", rgb, renderer},
      {"volume", "combinedvolume", rgb, renderer},
      {"volume", "volumedir", rgb, generic},
      {"volume", "volumeind", rgb, generic},
      {"volume", "volumelighting", rgb, generic},
      {"volume", "atmosphere", rgb, generic},
      {"transmission", "transmission", rgb, own},
      {"transmission", "transdir+transind*transcol", rgb, renderer},
      {"transmission", "transmissiondirect+transmissionindirect", rgb, renderer},
      {"transmission", "transmissive", rgb, renderer},
      {"transmission", "glossytransmission", rgb, renderer},
      {"transmission", "vrayrefraction", rgb, renderer},
      {"transmission", "refractions", rgb, renderer},
      {"transmission", "refraction", rgb, generic},
      {"transmission", "refract", rgb, generic},
      {"illumination", "illumination", rgb, own},
      {"illumination", "diffuseillumination", rgb, renderer},
      {"illumination", "diffdir+diffind", rgb, renderer},
      {"metallic", "metallic", "x|r|v|y|z|a", renderer},
      {"metallic", "metalness", "x|r|v|y|z|a", renderer},
      {"metallic", "metal", "x|r|v|y|z|a", generic},  // Unity
      {"metallic", "vraymetalness", "x|r|v|y|z|a", renderer},
      {"metallic", "*", "metalness", renderer},
      {"roughness", "roughness", "x|r|v|y|z|a", renderer},
      {"roughness", "specularroughness", "x|r|v|y|z|a", renderer},
      {"roughness", "vrayroughness", "x|r|v|y|z|a", renderer},
      {"roughness", "*", "specularroughness", renderer},
      {"reflectance", "reflectance", rgb, own},
      {"reflectance", "specularalbedo", rgb, renderer},
      {"reflectance", "glosscol", rgb, renderer},
      {"reflectance", "specularcolor", rgb, generic},

      // Geometry.
      {"position", "p", "r,g,b|red,green,blue", renderer},
      {"position", "position", xyz, renderer},
      {"position", "positions", xyz, renderer},
      {"position", "pworld", xyz, renderer},
      {"position", "worldposition", xyz, renderer},
      {"position", "absoluteworldposition", xyz, renderer},
      {"position", "cgeometryworldposition", xyz, renderer},
      {"position", "octposition", xyz, renderer},
      {"position", "hitp", xyz, renderer},
      {"position", "rayhitp", xyz, renderer},
      {"position", "pp", xyz, generic},
      {"back_depth", "backz", "z|v|r|y|x", generic},
      {"back_depth", "backdepth", "z|v|r|y|x", generic},
      {"instance", "instance", "x|r|v|y|z|id", generic},
      {"instance", "instanceid", "x|r|v|y|z|id", generic},
      {"instance", "shapeindex", "i|x|r|y", generic},
      {"seen_by_both", "", "both", own},
      {"mask", "", "mask", own},
      {"mask", "mask", "r|v|x|y|z|a|mask", generic},
      // Blender's Vector holds previous - current in x and y, y up.
      {"motion", "vector", "x,y", renderer, nothing, -1},
      {"motion", "motion", "r,g", renderer, unsure_motion},
      {"motion", "motionvector", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "motionvectors", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "velocity", "x,y|r,g|u,v", generic, unsure_motion},

      // Results.
      {"ao", "ao", "r|v|x|y|z", renderer},
      {"ao", "occlusion", "r|v|x|y|z", generic},
      {"ao", "ambientocclusion", "r|v|x|y|z", generic},
      {"ao", "*", "occlusion|ambientocclusion|ambient_occlusion", generic},
      {"bent_normal", "bentnormal", xyz, generic},
      {"frames", "", "frames", own},
  };
}

/// The channels that gloam writes for a plane.
Spelling own_spelling(const PlaneKind& kind) {
  const size_t dot = kind.channels.front().rfind('.');
  const std::string layer = dot == std::string::npos ? "*" : canonical(kind.channels.front().substr(0, dot));
  std::string components;
  for (const std::string& channel : kind.channels)
    components += (components.empty() ? "" : ",") + lower(channel.substr(channel.rfind('.') + 1));
  return {kind.name, layer, components, own};
}

}  // namespace

const std::vector<Spelling>& spellings() {
  static const std::vector<Spelling> all = [] {
    std::vector<Spelling> known = known_spellings();
    for (const PlaneKind& kind : plane_kinds()) {
      if (std::none_of(known.begin(), known.end(),
                       [&](const Spelling& s) { return s.plane == kind.name && s.rank == own; }))
        known.push_back(own_spelling(kind));
    }
    return known;
  }();
  return all;
}

const std::vector<Spelling>& spellings_of(const std::string& plane) {
  static const std::map<std::string, std::vector<Spelling>> by_plane = [] {
    std::map<std::string, std::vector<Spelling>> sorted;
    for (const Spelling& spelling : spellings()) sorted[spelling.plane].push_back(spelling);
    return sorted;
  }();
  static const std::vector<Spelling> none;
  const auto found = by_plane.find(plane);
  return found == by_plane.end() ? none : found->second;
}

bool is_other_data(const std::string& layer) {
  static const std::set<std::string> known = {"mist",      "uv",          "indexob",    "indexma",
                                              "disparity", "disparityl",  "disparityr", "volumez",
                                              "vector",    "cryptomatte", "id",         "gloamcomposite"};
  return known.contains(layer) || layer.starts_with("crypto");
}

}  // namespace gloam::channel_names
