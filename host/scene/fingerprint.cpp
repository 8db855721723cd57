#include "scene/fingerprint.h"

#include <fmt/format.h>

namespace gloam {
namespace {

void add_plane(Fingerprint& print, const Plane* plane) {
  if (!plane) return;
  for (const Channel& channel : plane->channels) print.add_bytes(channel.data(), channel.layout().bytes());
}

void add_camera(Fingerprint& print, const Camera& c) {
  print.add(std::vector<double>{c.fx, c.fy, c.cx, c.cy, c.near.value_or(0), double(c.orthographic)});
  if (c.slits) print.add(*c.slits->display), print.add(c.slits->module);
  if (!c.pose) return;
  print.add(c.pose->position);
  print.add(c.pose->world_to_view);
}

}  // namespace

void Fingerprint::add(const Scene& scene) {
  add(scene.origin);
  for (const Mesh& mesh : scene.meshes) {
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.uvs);
    add(mesh.triangles);
    const Material& material = scene.materials[size_t(mesh.material)];
    add(material.alpha_cutoff);
    if (material.alpha_cutoff > 0 && material.albedo_texture >= 0)
      add(scene.textures[size_t(material.albedo_texture)].texels);
  }
}

void Fingerprint::add_light(const Scene& scene) {
  add(scene.light);
  for (const Mesh& mesh : scene.meshes) add(mesh.material);
  for (const Material& m : scene.materials) {
    add(m.albedo), add(m.roughness), add(m.metallic), add(m.reflectance), add(m.emission);
    for (const int texture : {m.albedo_texture, m.roughness_texture, m.metallic_texture, m.emission_texture})
      add(texture);
  }
  for (const Texture& texture : scene.textures) add(texture.texels);
}

void Fingerprint::add_gloss(const Frame& frame) {
  for (const View& view : frame.views) {
    add_plane(*this, view.find("roughness"));
    add_plane(*this, view.find("reflectance"));
  }
}

void Fingerprint::add(const Frame& frame) {
  add(std::vector<int>{frame.window.x0, frame.window.y0});
  for (const View& view : frame.views) {
    add_plane(*this, view.find("depth"));
    add_plane(*this, view.find("normal"));
    add(view.name);
    if (view.camera) add_camera(*this, *view.camera);
  }
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", state_); }

}  // namespace gloam
