#include "scene/embree_filters.h"

#include <glm/geometric.hpp>

#include "scene/textures.h"

namespace gloam {

using glm::dvec3;
using glm::vec3;

vec3 barycentric(float u, float v) { return {1 - u - v, u, v}; }

glm::vec2 uv_at(const Mesh& mesh, unsigned triangle, vec3 weights) {
  if (mesh.uvs.empty()) return glm::vec2(0);
  const glm::uvec3 t = mesh.triangles[triangle];
  return weights.x * mesh.uvs[t.x] + weights.y * mesh.uvs[t.y] + weights.z * mesh.uvs[t.z];
}

namespace {

/// Whether the texture has a hole there.
bool is_cut_out(const Cutout& cutout, unsigned triangle, float u, float v) {
  const Material& material = cutout.scene->materials[size_t(cutout.mesh->material)];
  const Texture& texture = cutout.scene->textures[size_t(material.albedo_texture)];
  return texel(texture, uv_at(*cutout.mesh, triangle, barycentric(u, v)), false).a < material.alpha_cutoff;
}

}  // namespace

void pass_holes(const RTCFilterFunctionNArguments* arguments) {
  const Cutout& cutout = *static_cast<const Cutout*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (!arguments->valid[i]) continue;
    const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
    const float u = RTCHitN_u(arguments->hit, arguments->N, i), v = RTCHitN_v(arguments->hit, arguments->N, i);
    if (is_cut_out(cutout, triangle, u, v)) arguments->valid[i] = 0;
  }
}

void gather_hit(const RTCFilterFunctionNArguments* arguments) {
  auto& context = *reinterpret_cast<GatheringContext*>(arguments->context);
  const RTCHit hit = rtcGetHitFromHitN(arguments->hit, 1, 0);
  const RTCRay ray = rtcGetRayFromRayN(arguments->ray, 1, 0);
  if (arguments->valid[0]) context.hits->push_back({hit.geomID, hit.primID, ray.tfar, hit.u, hit.v});
  arguments->valid[0] = 0;
}

void pass_what_is_behind(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const SceneContext*>(arguments->context);
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    const float distance = RTCRayN_tfar(arguments->ray, n, i);
    const bool is_at_end = double(distance) > context.far * (1 - near_the_end);
    if (!arguments->valid[i] || (distance > context.near && !is_at_end)) continue;
    const Mesh& mesh = context.scene->meshes[RTCHitN_geomID(arguments->hit, n, i)];
    const glm::uvec3 t = mesh.triangles[RTCHitN_primID(arguments->hit, n, i)];
    const dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const dvec3 origin(RTCRayN_org_x(arguments->ray, n, i), RTCRayN_org_y(arguments->ray, n, i),
                       RTCRayN_org_z(arguments->ray, n, i));
    const dvec3 direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                          RTCRayN_dir_z(arguments->ray, n, i));
    const dvec3 normal = glm::cross(b - a, c - a);
    const double height = glm::dot(a - origin, normal), approach = glm::dot(direction, normal);
    if (distance <= context.near && height * approach <= 0) arguments->valid[i] = 0;
    if (is_at_end && height / approach > context.far) arguments->valid[i] = 0;
  }
}

}  // namespace gloam
