// Outlines around a scene's objects, and how many of them a ray is in ("Outline-Dependent Screen-Space Ambient Occlusion",
// 2020, sections 3.1 and 3.2).
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
  /// The outlines: meshes by the index of their objects, which are solid even where a texture has holes.
  const Scene& scene() const { return scene_; }
  /// Seconds that building took.
  double build_seconds() const { return build_seconds_; }

  /// +1 for each face of an outline that the ray enters by its front, -1 for each by its back, from ray.near on and
  /// before ray.far; a face at ray.far does not count.
  int crossings(const TracerRay& ray) const;

  /// How many objects a point is beside: outside of the object, inside of its outline. What `crossings` of a ray from there
  /// begins at. Parts that are not closed have no inside, and do not count.
  int around(const glm::dvec3& point) const;
  /// The same by one ray, in any direction. It may go wrong where it meets an edge.
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
