// Files of a scene as assimp's readers get them.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Gives assimp OBJ and MTL in a form that assimp reads right, and opens buffers whose names have escapes. Remembers which .mtl
/// files were of use, as assimp goes on without and says nothing, and what an OBJ holds.
class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  std::vector<std::string> found, missing, left_out;  ///< .mtl files; statements of them
  std::optional<size_t> faces;                        ///< of an OBJ file
  std::string why_not;                                ///< an OBJ file cannot be read

 private:
  Assimp::IOStream* open_obj(const std::filesystem::path& path);
  Assimp::IOStream* open_mtl(const std::filesystem::path& path);
};

/// Throws Error for a scene file that is missing, empty, a folder or not readable.
void check_scene_file(const std::filesystem::path& path);

}  // namespace gloam
