// A scene: triangle meshes with materials, lights and cameras, from a file or built in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/parameters.h"

namespace gloam {

/// An image of 8-bit RGBA texels, row 0 on top; repeats outside [0, 1].
struct Texture {
  std::string name;
  int width = 0, height = 0;
  std::vector<uint8_t> texels;  ///< 4 * width * height
};

/// The material of a surface, after glTF's metallic-roughness model. Textures are indices into Scene::textures, -1 for none; a
/// texture's value is multiplied by the factor of the same name.
struct Material {
  std::string name;
  glm::vec3 albedo{0.5f};  ///< base colour, linear
  float roughness = 1;     ///< perceptual; GGX alpha is its square
  float metallic = 0;
  float reflectance = 0.04f;   ///< F0 of the dielectric part
  glm::vec3 emission{0.0f};    ///< radiance, scene-linear
  int albedo_texture = -1;     ///< sRGB; its alpha is the opacity
  int roughness_texture = -1;  ///< linear; roughness in G
  int metallic_texture = -1;   ///< linear; metallic in B
  int emission_texture = -1;   ///< sRGB
  float alpha_cutoff = 0;      ///< below this alpha of the albedo texture there is no surface; 0: solid
};

/// One instance of a mesh, placed in the scene. Positions are relative to Scene::origin. Counter-clockwise triangles face the
/// viewer; both sides are visible.
struct Mesh {
  std::string name;
  int material = 0;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< one per position, unit, outward; empty: faces are flat
  std::vector<glm::vec2> uvs;      ///< one per position, as in glTF: (0, 0) is the texture's top left; or empty
  std::vector<glm::uvec3> triangles;
};

/// A camera of the scene, for any size of image. Positions are in the world (not relative to Scene::origin).
struct SceneCamera {
  std::string name;
  Pose pose;
  bool orthographic = false;
  double fov_degrees = 60;  ///< horizontal; perspective
  double width = 1;         ///< scene units across the image; orthographic
};

/// Intrinsics for a size: square pixels, centred.
Camera camera_for(const SceneCamera& camera, int width, int height);
/// A camera at `eye` that looks at `target`. Throws UsageError if the two are one point, or not finite.
SceneCamera looking_at(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target, double fov_degrees,
                       const glm::dvec3& up = {0, 1, 0});

/// Light for the colour plane: a sun with a disc, and a sky without occlusion.
struct Light {
  glm::vec3 to_sun{0.4f, 0.8f, 0.45f};   ///< direction, need not be unit
  glm::vec3 sun{2.6f, 2.3f, 1.9f};       ///< irradiance on a surface that faces it; 0: no sun
  float sun_angle_degrees = 1.5f;        ///< angular radius
  glm::vec3 zenith{0.35f, 0.5f, 0.8f};   ///< radiance of the sky above ...
  glm::vec3 horizon{0.7f, 0.75f, 0.8f};  ///< ... at the horizon
  glm::vec3 ground{0.25f, 0.23f, 0.2f};  ///< ... and below it
};

struct Scene {
  std::string name;
  glm::dvec3 origin{0.0};    ///< the point of the world that positions are relative to
  std::vector<Mesh> meshes;  ///< the index identifies the instance
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<SceneCamera> cameras;  ///< at least one; the first is the default
  glm::dvec3 up{0, 1, 0};
  Light light;
  double ao_radius = 0;            ///< radius of ambient occlusion that suits the scene, scene units; 0: unknown
  std::vector<std::string> notes;  ///< what was repaired or left out, one sentence each
  size_t faces() const;
};

/// A camera that moves through a built-in scene. Frames are numbered from 1; `frames_per_second` of them are a second.
struct ShotRecipe {
  std::string name;     ///< "walk"; no other shot of the scene has it
  std::string summary;  ///< one line
  int frames = 48;
  std::function<SceneCamera(double seconds)> camera;  ///< since the first frame; deterministic
  bool moves_objects = false;                         ///< the scene's parameter `time` takes the same seconds
};

inline constexpr double frames_per_second = 24;

/// Seconds from the first frame of a shot to another.
inline double seconds_of_frame(int frame) { return (frame - 1) / frames_per_second; }

/// A built-in scene.
struct SceneRecipe {
  std::string name;     ///< "courtyard"
  std::string summary;  ///< one line
  std::string kind;     ///< the kind of scene that it represents: "architecture", "thin", "object" or "flat"
  ParameterList parameters;
  std::function<Scene(const ParameterValues&)> make;  ///< deterministic
  std::vector<ShotRecipe> shots = {};
};

/// All of host/scene/built_in/, sorted by name.
const std::vector<SceneRecipe>& builtin_scenes();
/// nullptr if there is no such scene.
const SceneRecipe* find_builtin_scene(const std::string& name);

/// A scene by what a user typed: a built-in name, else a file. `settings`: name = value, for built-in scenes. Throws UsageError
/// for a name that is neither (with the nearest built-in name), for unknown settings and for values out of range; Error as
/// `import_scene` (import.h) does.
Scene load_scene(const std::string& name_or_path, const Settings& settings);

/// Largest coordinate of vertices and ray starts relative to a scene's origin: Embree computes in float, and ends the program
/// beyond.
inline constexpr double farthest_traced = 1e18;

/// Throws Error for a scene that cannot be traced: no triangle, an index out of range, a position or normal that is not finite, no
/// camera, 2^24 meshes or more.
void check(const Scene& scene);

}  // namespace gloam
