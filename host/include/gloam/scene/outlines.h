// Outlines around a scene's objects, and how many of them a ray is in ("Outline-Dependent Screen-Space Ambient Occlusion",
// 2020, sections 3.1 and 3.2).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gloam/scene/tracer.h"

namespace gloam {

/// How an object's vertices are pushed outwards. All three are the paper's; figure 4 compares them.
enum class OutlineMethod {
  integrated,  ///< algorithm 2: along the mean of the distinct normals of the faces around the vertex
  scaling,     ///< the object scaled about the centre of its bounding box
  normal       ///< along the vertex normal, else the face's: faces come apart at hard edges
};

/// By their place in the enumeration: integrated, scaling, normal.
const std::vector<std::string>& outline_methods();

struct OutlineOptions {
  double extent = 0;  ///< scene units, more than 0, 1e15 at most
  OutlineMethod method = OutlineMethod::integrated;
  double angle_degrees = 1;  ///< between face normals that count as one, at most; 0 to 90; integrated
};

/// An object's outline: the same triangles in the same order, with vertices moved. It has no normals and no texture
/// coordinates.
struct Outline {
  Mesh mesh;
  /// Per triangle: whether it belongs to a part of the object that is closed (each edge is used as often one way as the
  /// other, by exact position) and has stayed so. Only of such is inside and outside known.
  std::vector<char> closed;
};

/// `integrated`: vertices at the same position are one, and move by the whole extent along the mean made unit, as in the
/// paper: at a cube's corner faces move by extent / sqrt 3 (nothing is added to make up for that). Normals are taken in the
/// order of the faces; one within the angle of one taken before is left out. Where they cancel, as on a sheet with two sides,
/// the vertex stays.
/// `scaling`: the largest half extent of the bounding box grows by the extent.
/// `normal`: a mesh without normals has three vertices of its own per triangle then.
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
