#include "exr/channel_spellings.h"

#include <map>
#include <set>

namespace gloam::channel_names {
namespace {

constexpr const char* xyz = "x,y,z|r,g,b";
constexpr const char* rgb = "r,g,b|x,y,z";
constexpr const char* one = "z|v|r|y|x|a|depth";

}  // namespace

const std::vector<Spelling>& spellings() {
  using enum DeclaredConvention;
  static const std::vector<Spelling> table = {
      // Depth. gloam and OpenEXR: Z. Blender: Depth.Z, file output depth.V. RenderMan: z. Karma: Pz, hitPz, depth.
      // Mitsuba 2: the name that the user gave ("dd.y", "depth.Y"), Mitsuba 3: <name>.T, both ray distances.
      {"depth", "", "z", own},
      {"depth", "depth", "z", renderer, planar},
      {"depth", "depth", one, renderer},
      {"depth", "z", one, renderer},
      {"depth", "zdepth", one, renderer},
      {"depth", "depthz", one, renderer},
      {"depth", "worlddepth", one, renderer},
      {"depth", "scenedepth", one, renderer},
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
      {"normal", "n", "x,y,z", own},
      {"normal", "n", "r,g,b", renderer},
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
      {"normal", "hitn", xyz, renderer},
      {"normal", "rayhitn", xyz, renderer},
      {"normal", "ns", xyz, generic},
      {"normal", "cameranormal", xyz, generic, view_space},
      {"normal", "viewnormal", xyz, generic, view_space},
      {"normal", "normalcamera", xyz, generic, view_space},
      {"normal", "neye", xyz, generic, view_space},
      {"normal", "ncam", xyz, generic, view_space},
      {"normal", "geonormal", xyz, last_resort},
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
      {"alpha", "main", "a", generic},
      {"alpha", "alpha", "a|r|v|x|y|z", generic},
      {"alpha", "*", "alpha", generic},

      // Material.
      {"albedo", "albedo", rgb, own},
      {"albedo", "diffusealbedo", rgb, renderer},
      {"albedo", "diffcol", rgb, renderer},
      {"albedo", "basecolor", rgb, renderer},
      {"albedo", "basecolour", rgb, renderer},
      {"albedo", "diffusecolor", rgb, generic},
      {"albedo", "rawalbedo", rgb, generic},
      {"albedo", "denoisealbedo", rgb, last_resort},
      {"albedo", "denoisingalbedo", rgb, last_resort},
      {"roughness", "*", "roughness", own},
      {"roughness", "roughness", "x|r|v|y|z|a", renderer},
      {"roughness", "specularroughness", "x|r|v|y|z|a", renderer},
      {"roughness", "*", "specularroughness", renderer},
      {"reflectance", "reflectance", rgb, own},
      {"reflectance", "specularalbedo", rgb, renderer},
      {"reflectance", "glosscol", rgb, renderer},
      {"reflectance", "specularcolor", rgb, generic},

      // Geometry.
      {"position", "p", "x,y,z", own},
      {"position", "p", "r,g,b", renderer},
      {"position", "position", xyz, renderer},
      {"position", "pworld", xyz, renderer},
      {"position", "worldposition", xyz, renderer},
      {"position", "absoluteworldposition", xyz, renderer},
      {"position", "hitp", xyz, renderer},
      {"position", "rayhitp", xyz, renderer},
      {"position", "pp", xyz, generic},
      {"back_depth", "*", "backz", own},
      {"back_depth", "backz", "z|v|r|y|x", generic},
      {"back_depth", "backdepth", "z|v|r|y|x", generic},
      {"instance", "*", "instance", own},
      {"instance", "instance", "x|r|v|y|z|id", generic},
      {"instance", "instanceid", "x|r|v|y|z|id", generic},
      {"instance", "shapeindex", "i|x|r|y", generic},
      {"peel_count", "peel", "count", own},
      {"outline_count", "outline", "count", own},
      {"seen_by_both", "", "both", own},
      {"mask", "", "mask", own},
      {"mask", "mask", "r|v|x|y|z|a|mask", generic},
      // Blender's Vector holds previous - current in x and y, y up.
      {"motion", "motion", "x,y", own},
      {"motion", "vector", "x,y", renderer, nothing, -1},
      {"motion", "motion", "r,g", renderer, unsure_motion},
      {"motion", "motionvector", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "motionvectors", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "velocity", "x,y|r,g|u,v", generic, unsure_motion},

      // Results.
      {"ao", "*", "ao", own},
      {"ao", "ao", "r|v|x|y|z", renderer},
      {"ao", "occlusion", "r|v|x|y|z", generic},
      {"ao", "ambientocclusion", "r|v|x|y|z", generic},
      {"ao", "*", "occlusion|ambientocclusion|ambient_occlusion", generic},
      {"ao_raw", "*", "ao_raw", own},
      {"ao_error", "*", "ao_error", own},
      {"ao_noise", "*", "ao_noise", own},
      {"bent_normal", "bent", "x,y,z", own},
      {"bent_normal", "bentnormal", xyz, generic},
      {"cone", "*", "cone", own},
      {"reflection", "reflection", "r,g,b,a", own},
      {"reflection_raw", "reflectionraw", "r,g,b,a", own},
      {"frames", "", "frames", own},
      {"history", "history", "r,g,b,a", own},
      {"history_ao", "history", "visibility", own},
      {"history_indirect", "historyindirect", "r,g,b", own},
      {"history_depth", "history", "z", own},
      {"history_frames", "history", "frames", own},
      {"reflection_noise", "*", "reflection_noise", own},
      {"indirect", "indirect", "r,g,b", own},
      {"indirect_raw", "indirectraw", "r,g,b", own},
      {"indirect_noise", "*", "indirect_noise", own},
      {"bounces", "bounces", "r,g,b", own},
      {"bounces_noise", "*", "bounces_noise", own},
      {"specular_occlusion", "*", "specular_occlusion", own},
      {"specular_occlusion_raw", "*", "specular_occlusion_raw", own},
      {"lobe_weight", "*", "lobe_weight", own},
      {"specular_occlusion_noise", "*", "specular_occlusion_noise", own},
      {"contact", "*", "contact", own},
      {"contact_noise", "*", "contact_noise", own},
      {"environment", "environment", "r,g,b", own},
      {"environment_noise", "*", "environment_noise", own},
      {"hit", "hit", "z", own},
  };
  return table;
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
  return known.contains(layer);
}

}  // namespace gloam::channel_names
