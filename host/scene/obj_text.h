// OBJ and MTL files in a form that assimp reads correctly: it skips numbers that begin with a point, and stops at statements that
// it mistakes for others.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gloam {

struct ObjText {
  std::string text;
  size_t faces = 0;  ///< of three vertices and more
};

/// The same geometry with every number in the form 0.5. Words such as nan become numbers that are not finite. Throws Error naming
/// `file` and the line if a word stands where a number must be.
ObjText readable_obj(const std::string& text, const std::string& file);

struct MtlText {
  std::string text;
  std::vector<std::string> left_out;  ///< statements whose value is no number: "Kd spectral"
};

/// The same materials, without statements that assimp mistakes for others (`aniso`, `d -halo`) or cannot read.
MtlText readable_mtl(const std::string& text);

}  // namespace gloam
