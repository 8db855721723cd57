// Rays in Embree's form, and owners of Embree objects.
#pragma once

#include <embree3/rtcore.h>

#include <glm/vec3.hpp>

#include "gloam/scene/tracer.h"

namespace gloam {

struct FreeDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct FreeScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// Throws Error if Embree reports one.
void check_embree(RTCDevice device, const Scene& scene);

/// A ray in Embree's form, beginning at distance `start` along it.
RTCRay embree_ray(const TracerRay& ray, double start);

/// Up to 16 rays from one point.
struct RayPacket {
  alignas(64) int valid[16];
  RTCRayHit16 rays;

  RayPacket(const glm::vec3& origin, const glm::vec3* directions, int count, float far);
};

}  // namespace gloam
