#include "scene/embree_rays.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam {

using glm::dvec3;
using glm::vec3;

void check_embree(RTCDevice device, const Scene& scene) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error("{}: no memory to trace {} triangles; use a smaller scene", scene.name, scene.faces());
  throw Error("{}: cannot be traced, Embree's error {}", scene.name, int(error));
}

RTCRay embree_ray(const TracerRay& ray, double start) {
  const dvec3 origin = ray.origin + start * ray.direction;
  RTCRay out;
  out.org_x = float(origin.x), out.org_y = float(origin.y), out.org_z = float(origin.z);
  out.dir_x = float(ray.direction.x), out.dir_y = float(ray.direction.y), out.dir_z = float(ray.direction.z);
  out.tnear = float(std::max(ray.near - start, 0.0)), out.tfar = float(ray.far - start);
  out.time = 0, out.mask = ~0u, out.id = 0, out.flags = 0;
  return out;
}

RayPacket::RayPacket(const vec3& origin, const vec3* directions, int count, float far) {
  for (int i = 0; i < 16; ++i) {
    const vec3 direction = i < count ? directions[i] : vec3(0, 0, 1);
    valid[i] = i < count ? -1 : 0;
    rays.ray.org_x[i] = origin.x, rays.ray.org_y[i] = origin.y, rays.ray.org_z[i] = origin.z;
    rays.ray.dir_x[i] = direction.x, rays.ray.dir_y[i] = direction.y, rays.ray.dir_z[i] = direction.z;
    rays.ray.tnear[i] = 0, rays.ray.tfar[i] = far;
    rays.ray.time[i] = 0, rays.ray.mask[i] = ~0u, rays.ray.id[i] = 0, rays.ray.flags[i] = 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace gloam
