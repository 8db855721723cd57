// Outlines around a scene's objects, and the number of outlines that a ray is in ("Outline-Dependent Screen-Space Ambient
// Occlusion", 2020, sections 3.1 and 3.2).
#pragma once

#include <memory>
#include <vector>

#include "gloam/scene/outline_mesh.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// The outlines of all objects of a scene, ready for rays. Thread-safe. The tracer must outlive it.
class Outlines {
 public:
  /// Throws UsageError as `outline_of` does, and Error as Tracer does.
  Outlines(const Tracer& tracer, const OutlineOptions& options);
  Outlines(const Outlines&) = delete;
  Outlines& operator=(const Outlines&) = delete;

  const OutlineOptions& options() const { return options_; }
  /// The outlines as a scene. Meshes are in the order of their objects, and solid even where a texture has holes.
  const Scene& scene() const { return scene_; }
  /// Build time, seconds.
  double build_seconds() const { return build_seconds_; }

  /// +1 for each face of an outline that the ray enters by its front, -1 for each by its back, from ray.near to just before
  /// ray.far.
  int crossings(const TracerRay& ray) const;

  /// Number of objects that a point is near: outside the object, inside its outline. The start value for `crossings` of a ray from
  /// there. Parts that are not closed do not count.
  int around(const glm::dvec3& point) const;
  /// As above, by one ray in the given direction. It may be wrong if the ray meets an edge.
  int around(const glm::dvec3& point, const glm::dvec3& direction) const;

 private:
  const Tracer& objects_;
  OutlineOptions options_;
  Scene scene_;
  std::vector<std::vector<char>> closed_;  ///< per mesh and triangle
  std::unique_ptr<Tracer> outlines_;
  double build_seconds_ = 0;
};

}  // namespace gloam
