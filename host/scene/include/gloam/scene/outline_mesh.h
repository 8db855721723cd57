// The outline of an object: its mesh, with vertices pushed outwards ("Outline-Dependent Screen-Space Ambient Occlusion", 2020,
// section 3.1).
#pragma once

#include <string>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam {

/// How an object's vertices are moved outwards. All but `mitre` are the paper's; figure 4 compares them.
enum class OutlineMethod {
  mitre,       ///< as `integrated`, and so far that the faces, not the vertices, move by the extent
  integrated,  ///< algorithm 2: along the mean of the distinct normals of the faces around the vertex
  scaling,     ///< the object scaled about the centre of its bounding box
  normal       ///< along the vertex normal, else the face's: faces come apart at hard edges
};

/// Names in the order of the enumeration: mitre, integrated, scaling, normal.
const std::vector<std::string>& outline_methods();

struct OutlineOptions {
  double extent = 0;  ///< scene units, more than 0, 1e15 at most
  OutlineMethod method = OutlineMethod::mitre;
  double angle_degrees = 1;  ///< largest angle between face normals that count as one, 0 to 90; where `has_angle`
};

/// Whether a method takes the mean of distinct normals.
bool has_angle(OutlineMethod method);

/// Farthest that `mitre` moves a vertex, in extents: the tip of a needle is not drawn out.
constexpr double most_mitre = 2;

/// An object's outline: its triangles in the same order, with vertices moved. It has no normals and no texture coordinates.
struct Outline {
  Mesh mesh;
  /// Per triangle: whether its part of the object is closed (each edge is used as often one way as the other, by exact position)
  /// and still is so in the outline. Only closed parts have an inside and an outside.
  std::vector<char> closed;
};

/// `integrated`: vertices at the same position are moved as one, by the whole extent along the normalised mean normal, as in the
/// paper: at a cube's corner, faces move by extent / sqrt 3. Normals are taken in the order of the faces; a normal within the angle
/// of an earlier one is left out. If the normals cancel, as on a sheet with two sides, the vertex stays.
/// `mitre`: in the same direction, by the extent over the least cosine between the mean and the normals, `most_mitre` extents at most:
/// a cube's faces move by the extent.
/// `scaling`: the largest half extent of the bounding box grows by the extent.
/// `normal`: a mesh without normals gets three vertices of its own per triangle.
/// Throws UsageError for options out of range.
Outline outline_of(const Mesh& mesh, const OutlineOptions& options);

}  // namespace gloam
