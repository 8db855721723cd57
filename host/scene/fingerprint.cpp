#include "fingerprint.h"

#include <fmt/format.h>

namespace gloam {

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

std::string Fingerprint::text() const { return fmt::format("{:016x}", state_); }

}  // namespace gloam
