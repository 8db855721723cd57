// The files of a scene in the form that assimp's readers need.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Opens files for assimp: OBJ and MTL in a form that it reads correctly, and buffers whose names have escapes. Remembers which
/// .mtl files were usable, since assimp goes on without them silently, and the contents of an OBJ.
class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  std::vector<std::string> found, missing, left_out;  ///< .mtl files; statements of them
  std::optional<size_t> faces;                        ///< faces of an OBJ file
  std::string why_not;                                ///< why an OBJ file cannot be read
  std::exception_ptr refused;                         ///< what the ledger of files threw, which assimp would not pass on

 private:
  bool is_allowed(const std::filesystem::path& path);
  Assimp::IOStream* open_obj(const std::filesystem::path& path);
  Assimp::IOStream* open_mtl(const std::filesystem::path& path);
};

/// Throws Error for a scene file that is missing, empty, a folder or not readable.
void check_scene_file(const std::filesystem::path& path);

}  // namespace gloam
