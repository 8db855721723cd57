#include "gloam/technique.h"

#include "shared/both/params.h"
#include "shared/filter/bilateral_params.h"

#define SPECULAR_OCCLUSION_PARAMS(P)                                                                             \
  P(choice, method, sectors, (sectors, cone, lagarde),                                                           \
    "what tells where the lobe is closed: the slices of an AO technique, its bent normal and cone, or AO alone") \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO technique: the unit of depth_tolerance")  \
  P(int, half_width, 2, 0, 32, "pixels",                                                                         \
    "taps of the filter on either side of the pixel, along each axis; lagarde is not filtered, as its AO is")    \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                                         \
    "distance from the tangent plane at which a tap no longer counts")                                           \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians", "angle between normals at which a tap no longer counts")

PARAMS(SpecularOcclusionParams, SPECULAR_OCCLUSION_PARAMS)

namespace gloam::techniques {
namespace {

using Method = SpecularOcclusionParams::method_values;

/// What a pixel's own surface and its lobe are made of.
std::vector<std::string> with_surface(const std::vector<std::string>& planes) {
  std::vector<std::string> all = {"depth", "normal", "roughness"};
  all.insert(all.end(), planes.begin(), planes.end());
  return all;
}

std::vector<std::string> reads_with(const SpecularOcclusionParams& p) {
  if (p.method == Method::lagarde) return with_surface({"ao"});
  if (p.method == Method::cone) return with_surface({"bent_normal", "cone"});
  return with_surface({"specular_occlusion_raw", "lobe_weight"});
}

Pass of_each_pixel(const std::string& name, const std::string& kernel, const std::vector<std::string>& reads,
                   const std::string& result) {
  Pass pass{.name = name, .kernel = kernel, .writes = {{"result", result}}, .defines = {{"COLUMNS", 0}, {"ROWS", 0}}};
  for (const std::string& plane : reads) pass.reads.push_back(plane.c_str());
  return pass;
}

/// The mean over a square of pixels, each by how much of the lobe it knows: sums over rows, then over columns.
std::vector<Pass> filter(const std::string& source, bool is_weighted, int taps) {
  Pass rows{.name = "rows",
            .kernel = "specular_occlusion_rows",
            .reads = {"depth", "normal", "roughness", {"open", source}},
            .writes = {{"sum", "specular_occlusion_sum"}, {"weight", "specular_occlusion_weight"}},
            .defines = {{"COLUMNS", taps}, {"ROWS", 0}, {"WEIGHTED", is_weighted}},
            .footprint = {.columns = taps, .rows = 0}};
  if (is_weighted) rows.reads.push_back("lobe_weight");
  Pass columns{.name = "columns",
               .kernel = "specular_occlusion_columns",
               .reads = {"depth",
                         "normal",
                         "roughness",
                         {"sum", "specular_occlusion_sum"},
                         {"weight", "specular_occlusion_weight"}},
               .writes = {{"result", "specular_occlusion"}},
               .defines = {{"COLUMNS", 0}, {"ROWS", taps}},
               .footprint = {.columns = 0, .rows = taps}};
  return {std::move(rows), std::move(columns)};
}

std::vector<Pass> specular_occlusion_passes(const SpecularOcclusionParams& p) {
  if (p.method == Method::lagarde)
    return {of_each_pixel("from AO", "specular_occlusion_from_ao", reads_with(p), "specular_occlusion")};
  if (p.method == Method::sectors) return filter("specular_occlusion_raw", true, p.half_width);
  const std::string unfiltered = "specular_occlusion_of_cones";
  std::vector<Pass> passes = {of_each_pixel("from cones", "specular_occlusion_from_cone", reads_with(p), unfiltered)};
  for (Pass& pass : filter(unfiltered, false, p.half_width)) passes.push_back(std::move(pass));
  return passes;
}

}  // namespace

std::vector<Technique> specular_occlusion() {
  Technique t;
  t.name = "specular-occlusion";
  t.summary =
      "how far the directions that a glossy surface reflects are open: a factor on reflections of the environment";
  t.paper = "slices against a GGX lobe; Jimenez, Wu, Pesce, Jarabo 2016; Lagarde, de Rousiers 2014";
  t.source = "specular_occlusion/specular_occlusion.cl";
  t.reads = with_surface({"specular_occlusion_raw", "lobe_weight", "ao", "bent_normal", "cone"});
  t.reads_with = [](const ParameterValues& values) { return reads_with(values.as<SpecularOcclusionParams>()); };
  t.writes = {"specular_occlusion"};
  t.parameters = SpecularOcclusionParams::table();
  t.passes = passes_of(specular_occlusion_passes);
  return {t};
}

}  // namespace gloam::techniques
