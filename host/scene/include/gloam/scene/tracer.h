// Rays against a scene's triangles, with Embree.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam {

/// A point where a ray meets a surface. Positions are relative to Scene::origin, in double: the crossing of the ray with the
/// triangle's plane is recomputed, so that a surface is flat to double's rounding.
struct Surface {
  double distance = 0;  ///< along the ray, in units of its direction's length
  glm::dvec3 position{0.0};
  glm::dvec3 facing{0.0};  ///< unit normal of the triangle, on the ray's side
  glm::dvec3 normal{0.0};  ///< unit shading normal, on the ray's side of the surface it belongs to
  glm::vec2 uv{0.0f};
  int mesh = 0;  ///< index into Scene::meshes
  unsigned triangle = 0;
  bool back_face = false;  ///< the triangle is seen from its clockwise side
};

/// A face that a ray crosses.
struct Crossing {
  double distance = 0;  ///< as in Surface
  int mesh = 0;
  unsigned triangle = 0;
  bool back_face = false;
};

/// The material of a surface at a point, textures looked up.
struct SurfaceMaterial {
  glm::vec3 albedo{0.0f};  ///< base colour, linear
  float roughness = 1;
  float metallic = 0;
  glm::vec3 reflectance{0.0f};  ///< F0
  glm::vec3 emission{0.0f};
};

/// A ray for `Tracer`. The direction need not be unit; distances are in units of its length.
struct TracerRay {
  glm::dvec3 origin{0.0}, direction{0.0};
  double near = 0, far = std::numeric_limits<double>::infinity();
};

/// How rays are computed. `fastest`: with the best instructions of the CPU, so that the last bits differ from one CPU to another.
/// `reproducible`: with those that every x86-64 CPU has, and what a vendor's approximate reciprocal decides is decided again in double:
/// the same results on every such CPU and with any number of threads, for some more time.
enum class Tracing { fastest, reproducible };

/// A scene prepared for ray tracing. Thread-safe. The scene must outlive it.
class Tracer {
 public:
  /// Throws Error as `check(scene)` does, and if Embree runs out of memory.
  explicit Tracer(const Scene& scene, Tracing tracing = Tracing::fastest);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  const Scene& scene() const;

  /// The first surface on the ray. This and the functions below throw Error for a ray that is not finite.
  std::optional<Surface> first(const TracerRay& ray) const;

  /// The first surface on a ray from a point that was `lifted` off a surface, to the side that it faces, but not that surface
  /// itself. `far`: as in TracerRay.
  std::optional<Surface> first_from(const glm::vec3& lifted, const glm::dvec3& direction,
                                    double far = std::numeric_limits<double>::infinity()) const;

  /// All surfaces on the ray, nearest first. Two triangles of one mesh that meet under the ray count once.
  void all(const TracerRay& ray, std::vector<Surface>& surfaces) const;

  /// All faces that the ray crosses, nearest first. Triangles that join where the ray meets them are one face; other faces of a
  /// mesh at one position, which `all` counts as one surface, are each counted. So a closed mesh is left as often as it is entered.
  void crossings(const TracerRay& ray, std::vector<Crossing>& crossings) const;

  /// Whether rays from one point are blocked: `directions` are unit, distances in scene units; sets blocked[i]. `far`: for all
  /// rays.
  void blocked(const glm::vec3& origin, const glm::vec3* directions, int count, float far, bool* blocked) const;

  /// Distances from one point to the first surface of each ray; +inf if none is nearer than `far`.
  void distances(const glm::vec3& origin, const glm::vec3* directions, int count, float far, float* distances) const;

  /// A start for rays to the side of `facing` that do not meet the surface's own triangle: the position moved off by some units
  /// of the rounding of its coordinates. For `blocked` and `distances`, which ignore hits behind the start, computed in double.
  glm::vec3 lifted(const Surface& surface) const;

  SurfaceMaterial material(const Surface& surface) const;

  /// Build time, seconds.
  double build_seconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gloam
