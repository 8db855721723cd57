// Outlines around a scene's objects, and the number of outlines that a ray is in ("Outline-Dependent Screen-Space Ambient
// Occlusion", 2020, sections 3.1 and 3.2).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gloam/scene/tracer.h"

namespace gloam {

/// How an object's vertices are moved outwards. All three methods are the paper's; figure 4 compares them.
enum class OutlineMethod {
  integrated,  ///< algorithm 2: along the mean of the distinct normals of the faces around the vertex
  scaling,     ///< the object scaled about the centre of its bounding box
  normal       ///< along the vertex normal, else the face's: faces come apart at hard edges
};

/// Names in the order of the enumeration: integrated, scaling, normal.
const std::vector<std::string>& outline_methods();

struct OutlineOptions {
  double extent = 0;  ///< scene units, more than 0, 1e15 at most
  OutlineMethod method = OutlineMethod::integrated;
  double angle_degrees = 1;  ///< largest angle between face normals that count as one, 0 to 90; integrated only
};

/// An object's outline: its triangles in the same order, with vertices moved. It has no normals and no texture coordinates.
struct Outline {
  Mesh mesh;
  /// Per triangle: whether its part of the object is closed (each edge is used as often one way as the other, by exact position)
  /// and still is so in the outline. Only closed parts have an inside and an outside.
  std::vector<char> closed;
};

/// `integrated`: vertices at the same position are moved as one, by the whole extent along the normalised mean normal, as in the
/// paper: at a cube's corner, faces move by extent / sqrt 3, and nothing makes up for that. Normals are taken in the order of the
/// faces; a normal within the angle of an earlier one is left out. If the normals cancel, as on a sheet with two sides, the vertex
/// stays.
/// `scaling`: the largest half extent of the bounding box grows by the extent.
/// `normal`: a mesh without normals gets three vertices of its own per triangle.
/// Throws UsageError for options out of range.
Outline outline_of(const Mesh& mesh, const OutlineOptions& options);

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
