// Fields of a camera JSON, checked: a message names the file, the field and what is expected there.
#pragma once

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace gloam {

/// The fields of one view: looked up in the view itself, then at the top of the document.
struct CameraFields {
  std::string file;
  std::string prefix;  ///< the view's name in messages: "views[1]."; empty if the document is the view
  const nlohmann::json& view;
  const nlohmann::json& top;

  /// The field, or nullptr if it is missing or null.
  const nlohmann::json* find(const char* name) const;
  /// None if the field is missing or null. Throws Error for another type and for a number that is not finite.
  std::optional<double> number(const char* name) const;
  /// A number > 0.
  std::optional<double> positive(const char* name) const;
  std::optional<std::string> text(const char* name) const;
  /// A 4x4 matrix written row by row, for column vectors; `m[column][row]` as in GLM.
  std::optional<glm::dmat4> matrix(const char* name) const;
  /// Throws Error: "FILE: NAME FAULT; expected EXPECTED".
  [[noreturn]] void refuse(const std::string& name, const std::string& fault, const std::string& expected) const;
};

/// "is of type array"
std::string type_in_words(const nlohmann::json& value);

}  // namespace gloam
