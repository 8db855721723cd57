#include "gloam/scene/tracer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <tuple>

#include "gloam/error.h"
#include "scene/embree_filters.h"
#include "scene/embree_rays.h"
#include "scene/textures.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

/// Two hits nearer to each other than this share of their distance are one surface: triangles that join under the ray.
constexpr double same_place = 1e-6;

dvec3 unit_or(const dvec3& v, const dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

/// Whether one of the first `count` surfaces or crossings, which are sorted, is the same one, met twice where two triangles join.
/// `joins`: whether two hits at one position do.
template <typename Surface, typename Joins>
bool is_there_already(const std::vector<Surface>& surfaces, size_t count, const Surface& surface, const Joins& joins) {
  for (size_t i = count; i-- > 0;) {
    const Surface& other = surfaces[i];
    if (surface.distance - other.distance > same_place * surface.distance) return false;
    if (other.mesh == surface.mesh && other.back_face == surface.back_face && joins(other, surface)) return true;
  }
  return false;
}

/// Embree's settings. GLOAM_EMBREE_ISA (sse4.2, avx, avx2, avx512) is for trying whether results depend on its instructions.
std::string reproducible_device() {
  const char* isa = std::getenv("GLOAM_EMBREE_ISA");
  return fmt::format("isa={},threads=1", isa ? isa : "sse2");
}

}  // namespace

struct Tracer::Impl {
  const Scene& scene;
  std::unique_ptr<RTCDeviceTy, FreeDevice> device;
  std::unique_ptr<RTCSceneTy, FreeScene> embree;
  std::vector<std::unique_ptr<Cutout>> cutouts;
  dvec3 centre{0.0};  ///< of a sphere around everything
  double extent = 0;  ///< its radius
  double build_seconds = 0;
  const bool is_reproducible;

  Impl(const Scene& scene, Tracing tracing) : scene(scene), is_reproducible(tracing == Tracing::reproducible) {}
  void add(const Mesh& mesh, unsigned id);
  std::vector<RawHit>& hits_of(const TracerRay& ray, double start) const;
  const std::vector<RawHit>& gathered(const TracerRay& ray) const;
  std::optional<Surface> nearest_beside(const TracerRay& ray, double start, const RawHit& hit) const;
  bool join(const Crossing& a, const Crossing& b) const;
  Crossing crossing(const TracerRay& ray, const RawHit& hit, const dvec3& normal) const;
  dvec3 normal(const TracerRay& ray, const RawHit& hit) const;
  Surface surface(const TracerRay& ray, const RawHit& hit) const;
  void bound();
  std::optional<double> start_of(const TracerRay& ray) const;
  SceneContext context(double far) const;
  double searched(double far) const;
  vec3 weights_of(const RawHit& hit, const dvec3& position) const;
  std::optional<Surface> first(const TracerRay& ray, RTCIntersectContext& context) const;
};

void Tracer::Impl::bound() {
  dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Mesh& mesh : scene.meshes) {
    for (const vec3& p : mesh.positions) low = glm::min(low, dvec3(p)), high = glm::max(high, dvec3(p));
  }
  centre = 0.5 * (low + high);
  extent = 0.5 * glm::length(high - low);
}

/// Where along a ray Embree begins: not far before the scene, since its floats are inexact far away. None if the ray ends before
/// the scene.
std::optional<double> Tracer::Impl::start_of(const TracerRay& ray) const {
  const double length = glm::length(ray.direction), far_away = glm::length(ray.origin);
  if (!(length > 0 && std::isfinite(length) && std::isfinite(far_away)) || std::isnan(ray.near) || std::isnan(ray.far))
    throw Error("{}: a ray that is not finite cannot be traced; check the camera", scene.name);
  if (far_away > farthest_traced || length > farthest_traced)
    throw Error(
        "{}: a ray starts {:g} from the middle of the scene; up to {:g} is traced: check the camera, and gloamOrigin "
        "in "
        "the frame's header",
        scene.name, far_away, farthest_traced);
  const double middle = glm::dot(centre - ray.origin, ray.direction) / (length * length);
  const double entry = middle - 1.01 * extent / length;
  // From inside or near the scene, rays start at their own start.
  const double start = ray.near < 0 || entry > extent / length ? std::max(entry, ray.near) : std::min(ray.near, 0.0);
  if (!(start < ray.far && ray.near < ray.far)) return {};
  return start;
}

/// How far Embree has to search for hits up to `far`, which a filter or `first` then decides on in double.
double Tracer::Impl::searched(double far) const { return is_reproducible ? far * (1 + near_the_end) : far; }

/// Weights of a triangle's vertices at a point of it.
vec3 Tracer::Impl::weights_of(const RawHit& hit, const dvec3& position) const {
  if (!is_reproducible) return barycentric(hit.u, hit.v);
  const Mesh& mesh = scene.meshes[hit.mesh];
  const glm::uvec3 t = mesh.triangles[hit.triangle];
  const dvec3 a = mesh.positions[t.x], b = dvec3(mesh.positions[t.y]) - a, c = dvec3(mesh.positions[t.z]) - a;
  const dvec3 normal = glm::cross(b, c), p = position - a;
  const double area = glm::dot(normal, normal);
  if (!(area > 0)) return {1, 0, 0};
  return barycentric(float(glm::dot(glm::cross(p, c), normal) / area),
                     float(glm::dot(glm::cross(b, p), normal) / area));
}

/// `far`: of the rays.
SceneContext Tracer::Impl::context(double far) const {
  SceneContext context;
  rtcInitIntersectContext(&context.base);
  context.base.filter = pass_what_is_behind;
  context.scene = &scene;
  context.near = float(extent * 0x1p-12);
  if (is_reproducible) context.far = far;
  return context;
}

void Tracer::Impl::add(const Mesh& mesh, unsigned id) {
  if (mesh.triangles.empty()) return;
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                            mesh.positions.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            mesh.triangles.size());
  check_embree(device.get(), scene);
  std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(vec3));
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
  if (has_holes(scene, mesh)) {
    cutouts.push_back(std::make_unique<Cutout>(Cutout{&scene, &mesh}));
    rtcSetGeometryUserData(geometry, cutouts.back().get());
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree.get(), geometry, id);
  rtcReleaseGeometry(geometry);
}

dvec3 Tracer::Impl::normal(const TracerRay& ray, const RawHit& hit) const {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const glm::uvec3 t = mesh.triangles[hit.triangle];
  const dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return unit_or(glm::cross(b - a, c - a), -glm::normalize(ray.direction));
}

Crossing Tracer::Impl::crossing(const TracerRay& ray, const RawHit& hit, const dvec3& normal) const {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const dvec3 a = mesh.positions[mesh.triangles[hit.triangle].x];
  // Crossing of the ray with the triangle's plane, in double; Embree's distance if the ray runs along the plane.
  const double approach = glm::dot(ray.direction, normal);
  double distance = glm::dot(a - ray.origin, normal) / approach;
  if (!(std::abs(distance - hit.distance) <= 1e-3 * std::abs(hit.distance))) distance = hit.distance;
  return {distance, int(hit.mesh), hit.triangle, approach > 0};
}

Surface Tracer::Impl::surface(const TracerRay& ray, const RawHit& hit) const {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const glm::uvec3 t = mesh.triangles[hit.triangle];
  const dvec3 normal = this->normal(ray, hit);
  const Crossing crossing = this->crossing(ray, hit, normal);
  Surface surface;
  surface.mesh = crossing.mesh;
  surface.triangle = crossing.triangle;
  surface.distance = crossing.distance;
  surface.position = ray.origin + surface.distance * ray.direction;
  surface.back_face = crossing.back_face;
  surface.facing = surface.back_face ? -normal : normal;
  const vec3 weights = weights_of(hit, surface.position);
  surface.uv = uv_at(mesh, hit.triangle, weights);
  surface.normal = surface.facing;
  if (!mesh.normals.empty()) {
    const dvec3 smooth =
        unit_or(weights.x * mesh.normals[t.x] + weights.y * mesh.normals[t.y] + weights.z * mesh.normals[t.z], normal);
    // Turned to the ray's side, however triangle and normal are oriented.
    surface.normal = glm::dot(smooth, surface.facing) < 0 ? -smooth : smooth;
  }
  return surface;
}

Tracer::Tracer(const Scene& scene, Tracing tracing) : impl_(std::make_unique<Impl>(scene, tracing)) {
  check(scene);
  impl_->bound();
  const auto start = std::chrono::steady_clock::now();
  // Embree's tree, and so which of two triangles that meet under a ray it finds first, depends on the number of threads.
  impl_->device.reset(rtcNewDevice(impl_->is_reproducible ? reproducible_device().c_str() : nullptr));
  if (!impl_->device) throw Error("{}: Embree does not start", scene.name);
  impl_->embree.reset(rtcNewScene(impl_->device.get()));
  rtcSetSceneFlags(impl_->embree.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (size_t i = 0; i < scene.meshes.size(); ++i) impl_->add(scene.meshes[i], unsigned(i));
  rtcCommitScene(impl_->embree.get());
  check_embree(impl_->device.get(), scene);
  impl_->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Tracer::~Tracer() = default;

const Scene& Tracer::scene() const { return impl_->scene; }

double Tracer::build_seconds() const { return impl_->build_seconds; }

std::optional<Surface> Tracer::Impl::first(const TracerRay& ray, RTCIntersectContext& context) const {
  const std::optional<double> start = start_of(ray);
  if (!start) return {};
  RTCRayHit query;
  query.ray = embree_ray({ray.origin, ray.direction, ray.near, searched(ray.far)}, *start);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const RawHit hit{query.hit.geomID, query.hit.primID, *start + double(query.ray.tfar), query.hit.u, query.hit.v};
  if (is_reproducible) return nearest_beside(ray, *start, hit);
  return surface(ray, hit);
}

/// Which of several surfaces in one place is the nearest, Embree decides by its inexact distances, and those of meshes that touch are in
/// one place. So all around its hit are compared in double.
std::optional<Surface> Tracer::Impl::nearest_beside(const TracerRay& ray, double start, const RawHit& hit) const {
  const double distance = hit.distance - start;
  TracerRay beside = ray;
  beside.near = start + distance * (1 - near_the_end), beside.far = start + distance * (1 + near_the_end);
  std::vector<RawHit>& hits = hits_of(beside, start);
  hits.push_back(hit);
  const auto place_of = [&](const RawHit& one) {
    const Crossing at = crossing(ray, one, normal(ray, one));
    return std::tuple(at.distance, one.mesh, one.triangle);
  };
  const RawHit* best = nullptr;
  decltype(place_of(hit)) best_place;
  for (const RawHit& one : hits) {
    const auto place = place_of(one);
    if (std::get<0>(place) <= ray.near || std::get<0>(place) > ray.far || (best && place >= best_place)) continue;
    best = &one;
    best_place = place;
  }
  if (!best) return {};
  return surface(ray, *best);
}

std::optional<Surface> Tracer::first(const TracerRay& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return impl_->first(ray, context);
}

std::optional<Surface> Tracer::first_from(const vec3& lifted, const dvec3& direction, double far) const {
  SceneContext context = impl_->context(far);
  return impl_->first({dvec3(lifted), direction, 0, far}, context.base);
}

/// All hits that Embree reports, in its order, with their distances from the ray's own start; valid until the thread's next call.
std::vector<RawHit>& Tracer::Impl::hits_of(const TracerRay& ray, double start) const {
  thread_local std::vector<RawHit> hits;
  hits.clear();
  GatheringContext context;
  rtcInitIntersectContext(&context.base);
  context.base.filter = gather_hit;
  context.hits = &hits;
  RTCRayHit query;
  query.ray = embree_ray(ray, start);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree.get(), &context.base, &query);
  for (RawHit& hit : hits) hit.distance += start;
  return hits;
}

const std::vector<RawHit>& Tracer::Impl::gathered(const TracerRay& ray) const {
  static const std::vector<RawHit> none;
  const std::optional<double> start = start_of(ray);
  return start ? hits_of(ray, *start) : none;
}

/// Whether two triangles share a vertex, by position.
bool Tracer::Impl::join(const Crossing& a, const Crossing& b) const {
  const Mesh& mesh = scene.meshes[size_t(a.mesh)];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.positions[mesh.triangles[a.triangle][i]] == mesh.positions[mesh.triangles[b.triangle][k]]) return true;
    }
  }
  return false;
}

void Tracer::crossings(const TracerRay& ray, std::vector<Crossing>& crossings) const {
  crossings.clear();
  for (const RawHit& hit : impl_->gathered(ray))
    crossings.push_back(impl_->crossing(ray, hit, impl_->normal(ray, hit)));
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.distance, a.mesh, a.triangle) < std::tie(b.distance, b.mesh, b.triangle);
  });
  const auto joins = [&](const Crossing& a, const Crossing& b) { return impl_->join(a, b); };
  size_t kept = 0;
  for (const Crossing& crossing : crossings) {
    if (!is_there_already(crossings, kept, crossing, joins)) crossings[kept++] = crossing;
  }
  crossings.resize(kept);
}

void Tracer::all(const TracerRay& ray, std::vector<Surface>& surfaces) const {
  surfaces.clear();
  for (const RawHit& hit : impl_->gathered(ray)) surfaces.push_back(impl_->surface(ray, hit));
  std::sort(surfaces.begin(), surfaces.end(), [](const Surface& a, const Surface& b) {
    return std::tie(a.distance, a.mesh, a.triangle) < std::tie(b.distance, b.mesh, b.triangle);
  });
  size_t kept = 0;
  const auto any = [](const Surface&, const Surface&) { return true; };
  for (const Surface& surface : surfaces) {
    if (!is_there_already(surfaces, kept, surface, any)) surfaces[kept++] = surface;
  }
  surfaces.resize(kept);
}

void Tracer::blocked(const vec3& origin, const vec3* directions, int count, float far, bool* blocked) const {
  SceneContext context = impl_->context(double(far));
  for (int first = 0; first < count; first += 16) {
    const int n = std::min(16, count - first);
    RayPacket packet(origin, directions + first, n, float(impl_->searched(double(far))));
    rtcOccluded16(packet.valid, impl_->embree.get(), &context.base, &packet.rays.ray);
    for (int i = 0; i < n; ++i) blocked[first + i] = packet.rays.ray.tfar[i] < 0;
  }
}

void Tracer::distances(const vec3& origin, const vec3* directions, int count, float far, float* distances) const {
  SceneContext context = impl_->context(double(far));
  for (int first = 0; first < count; first += 16) {
    const int n = std::min(16, count - first);
    RayPacket packet(origin, directions + first, n, float(impl_->searched(double(far))));
    rtcIntersect16(packet.valid, impl_->embree.get(), &context.base, &packet.rays);
    for (int i = 0; i < n; ++i) {
      const bool hit = packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      distances[first + i] = hit ? packet.rays.ray.tfar[i] : std::numeric_limits<float>::infinity();
      if (!hit || !impl_->is_reproducible) continue;
      const TracerRay ray{dvec3(origin), dvec3(directions[first + i])};
      const RawHit raw{packet.rays.hit.geomID[i], packet.rays.hit.primID[i], double(distances[first + i]), 0, 0};
      distances[first + i] = float(impl_->crossing(ray, raw, impl_->normal(ray, raw)).distance);
    }
  }
}

vec3 Tracer::lifted(const Surface& surface) const {
  // Moved by some units of the rounding of the point's own coordinates; `pass_what_is_behind` handles the rest.
  const dvec3 place = glm::abs(surface.position);
  return vec3(surface.position + std::max({place.x, place.y, place.z}) * 0x1p-21 * surface.facing);
}

SurfaceMaterial Tracer::material(const Surface& surface) const {
  const Scene& scene = impl_->scene;
  const Material& from = scene.materials[size_t(scene.meshes[size_t(surface.mesh)].material)];
  const auto looked_up = [&](int texture, bool srgb) {
    return texture < 0 ? glm::vec4(1) : texel(scene.textures[size_t(texture)], surface.uv, srgb);
  };
  SurfaceMaterial material;
  material.albedo = from.albedo * vec3(looked_up(from.albedo_texture, true));
  material.roughness = from.roughness * looked_up(from.roughness_texture, false).g;
  material.metallic = from.metallic * looked_up(from.metallic_texture, false).b;
  material.emission = from.emission * vec3(looked_up(from.emission_texture, true));
  material.reflectance = glm::mix(vec3(from.reflectance), material.albedo, material.metallic);
  return material;
}

}  // namespace gloam
