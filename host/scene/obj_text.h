// OBJ and MTL files as assimp reads them right: it passes over numbers that begin with a point, and ends at statements that it takes
// for others.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gloam {

struct ObjText {
  std::string text;
  size_t faces = 0;  ///< of three vertices and more
};

/// The same geometry, every number in the form 0.5. What is no number becomes one that is not finite, and a word where a number
/// has to be throws Error naming `file` and the line.
ObjText readable_obj(const std::string& text, const std::string& file);

struct MtlText {
  std::string text;
  std::vector<std::string> left_out;  ///< statements whose value is no number: "Kd spectral"
};

/// The same materials, without statements that assimp takes for others (`aniso`, `d -halo`) or cannot read.
MtlText readable_mtl(const std::string& text);

}  // namespace gloam
