// Rays as Embree takes them, and its objects.
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

/// Throws what Embree has to say, if anything.
void check_embree(RTCDevice device, const Scene& scene);

/// A ray as Embree takes it, from `start` along it on.
RTCRay embree_ray(const TracerRay& ray, double start);

/// Up to 16 rays from one point.
struct RayPacket {
  alignas(64) int valid[16];
  RTCRayHit16 rays;

  RayPacket(const glm::vec3& origin, const glm::vec3* directions, int count, float far);
};

}  // namespace gloam
