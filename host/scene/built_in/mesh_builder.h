// Shapes for the built-in scenes; they append to a mesh. Metres, y up, counter-clockwise seen from outside. All deterministic: no
// random device, only `hash01`.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam::scenes {

using glm::vec2;
using glm::vec3;

/// A number in [0, 1) that depends only on its arguments.
float hash01(uint32_t a, uint32_t b = 0, uint32_t c = 0);

/// Smooth noise in [0, 1]; its cells have sides of 1.
float noise(float x, float y, uint32_t seed);

/// The colour of a picture at a point in [0, 1]^2, as stored (sRGB); x to the right, y down.
using Painter = std::function<vec3(float x, float y)>;

/// Adds an opaque texture, painted at the texel centres and clamped to 0..1, and returns its index.
int add_texture(Scene& scene, const std::string& name, int width, int height, const Painter& painter);

/// Adds a material and returns its index.
int add_material(Scene& scene, const std::string& name, vec3 albedo, float roughness = 0.8f, float metallic = 0);

/// Adds an empty mesh (one instance) and returns a reference that the next call invalidates.
Mesh& add_mesh(Scene& scene, const std::string& name, int material);

/// The functions below give every vertex a normal: `Mesh::normals` is always as long as `Mesh::positions`.

/// Axis-aligned box, flat.
void add_box(Mesh& mesh, vec3 low, vec3 high);
/// Two triangles a b c d, counter-clockwise seen from the front; flat. `divisions` per side subdivides it.
void add_quad(Mesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d, int divisions = 1);
/// One flat triangle.
void add_triangle(Mesh& mesh, vec3 a, vec3 b, vec3 c);
/// Capped cone or cylinder between two points; smooth side, flat caps.
void add_cylinder(Mesh& mesh, vec3 from, vec3 to, float radius_from, float radius_to, int sides = 24, bool caps = true);
/// Sphere, smooth.
void add_sphere(Mesh& mesh, vec3 centre, float radius, int segments = 32, int rings = 16);
/// Surface of revolution about the vertical axis through `base`: profile points are (radius, height), from bottom to
/// top. Smooth, except where consecutive profile points repeat (a repeated point makes a crease).
void add_lathe(Mesh& mesh, vec3 base, const std::vector<vec2>& profile, int segments = 32);
/// Grid over [0, 1]^2; `surface(u, v)` gives positions, counter-clockwise when u goes right and v up. Smooth normals by
/// differences.
void add_surface(Mesh& mesh, const std::function<vec3(float u, float v)>& surface, int columns, int rows);
/// A flat outline (x, y), counter-clockwise, may be concave but not self-crossing, extruded along +z from z0 to z1; flat, with
/// caps.
void add_extrusion(Mesh& mesh, const std::vector<vec2>& outline, float z0, float z1);
/// As above, with holes: outlines inside the outer one that neither touch it nor each other, counter-clockwise as well.
void add_extrusion(Mesh& mesh, const std::vector<vec2>& outline, const std::vector<std::vector<vec2>>& holes, float z0,
                   float z1);
/// A flat sheet, one layer: the point (x, y) of an outline lies at origin + x * across + y * up. Its front faces the direction
/// across x up. Outlines as for `add_extrusion`.
void add_polygon(Mesh& mesh, vec3 origin, vec3 across, vec3 up, const std::vector<vec2>& outline,
                 const std::vector<std::vector<vec2>>& holes = {});
/// A quad with texture coordinates: the texture's bottom left at `a`, its top right at `c`. For meshes of such quads only.
void add_textured_quad(Mesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d);
/// Axis-aligned box whose edges are cut off at 45 degrees, `chamfer` metres from each; flat.
void add_chamfered_box(Mesh& mesh, vec3 low, vec3 high, float chamfer);
/// Round bar along a path of at least two points, capped; smooth side.
void add_tube(Mesh& mesh, const std::vector<vec3>& path, float radius, int sides = 8);
/// Ring about `axis`: `radius` from the centre to the middle of the bar, `thickness` is the bar's radius; smooth.
void add_torus(Mesh& mesh, vec3 centre, vec3 axis, float radius, float thickness, int segments = 32, int sides = 12);

/// Outlines, counter-clockwise, for the functions above.
std::vector<vec2> rectangle(vec2 low, vec2 high);
std::vector<vec2> circle(vec2 centre, float radius, int sides = 24);
/// A rectangle from `low` with a half circle on top that starts at height `spring`.
std::vector<vec2> arch(vec2 low, float width, float spring, int segments = 12);
/// A rectangle with openings along its lower side, from left to right: outlines as `rectangle` and `arch` make them.
std::vector<vec2> wall(vec2 low, vec2 high, const std::vector<std::vector<vec2>>& doors);
/// `count` points of a rope that hangs between two points and sags by `sag` metres in the middle (a parabola).
std::vector<vec3> hanging_rope(vec3 from, vec3 to, float sag, int count = 16);

/// Appends `source`, transformed; normals by the inverse transpose, mirrored triangles reversed. Texture coordinates are kept if
/// all of `mesh` has them.
void append(Mesh& mesh, const Mesh& source, const glm::mat4& transform);

/// Adds a mesh to the scene: `shape`, transformed.
void place(Scene& scene, const std::string& name, int material, const Mesh& shape, const glm::mat4& transform);

glm::mat4 moved(vec3 offset);
/// Turned counter-clockwise about +y, radians.
glm::mat4 turned_y(float angle);
/// Turned counter-clockwise about any axis, radians.
glm::mat4 turned(float angle, vec3 axis);
glm::mat4 scaled(vec3 factors);

}  // namespace gloam::scenes
