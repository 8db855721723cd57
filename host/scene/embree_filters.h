// Filters that Embree calls for each hit: they let rays pass through holes, or gather hits.
#pragma once

#include <embree3/rtcore.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam {

/// Weights of a triangle's vertices at a hit.
glm::vec3 barycentric(float u, float v);

/// Texture coordinates at a hit; 0 if the mesh has none.
glm::vec2 uv_at(const Mesh& mesh, unsigned triangle, glm::vec3 weights);

/// A filter's data for a mesh whose texture has holes.
struct Cutout {
  const Scene* scene;
  const Mesh* mesh;
};

/// Lets rays pass through holes.
void pass_holes(const RTCFilterFunctionNArguments* arguments);

/// A hit as Embree reports it.
struct RawHit {
  unsigned mesh, triangle;
  double distance;
  float u, v;
};

/// Embree's context with a list behind it, for `gather_hit`.
struct GatheringContext {
  RTCIntersectContext base;
  std::vector<RawHit>* hits;
};

/// Records every hit and lets the ray go on.
void gather_hit(const RTCFilterFunctionNArguments* arguments);

/// Embree's context with the scene behind it, for `pass_what_is_behind`.
struct SceneContext {
  RTCIntersectContext base;
  const Scene* scene;
  float near;  ///< hits nearer than this are checked again
  /// Where rays end, if Embree's own distances must not decide it; hits nearer to it than `near_the_end` are checked again.
  double far = std::numeric_limits<double>::infinity();
};

/// Share of a ray's length by which Embree's distance, in float, may be wrong by far.
inline constexpr double near_the_end = 1e-5;

/// Ignores hits due to rounding: triangles that in double lie behind the ray's start, such as the one that the ray leaves, or beyond
/// its end.
void pass_what_is_behind(const RTCFilterFunctionNArguments* arguments);

}  // namespace gloam
