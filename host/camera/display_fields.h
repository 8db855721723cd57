// Fields of a display JSON, checked: a message names the file, the field and what is expected there.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Largest absolute value of any number in a display.
inline constexpr double largest_in_display = 1e12;

/// An object of the document. All functions throw Error for a field of the wrong type and for a number that is not finite.
struct DisplayFields {
  const std::string& file;
  std::string name;  ///< its name in messages: "screen", "modules.list[3]"; empty for the document itself
  const nlohmann::json& value;

  std::string name_of(const std::string& field) const { return name.empty() ? field : name + "." + field; }

  /// Throws Error: "FILE: FIELD FAULT; expected EXPECTED".
  [[noreturn]] void refuse(const std::string& field, const std::string& fault, const std::string& expected) const;
  /// Throws Error for a field that is not `known`: a misspelt field would count as missing.
  void check_fields(const std::vector<std::string>& known) const;

  /// The field, or nullptr if it is missing or null.
  const nlohmann::json* find(const std::string& field) const;
  /// An object inside this one. Throws Error for fields of it that are not `known`.
  std::optional<DisplayFields> object(const std::string& field, const std::vector<std::string>& known) const;
  DisplayFields needed_object(const std::string& field, const std::vector<std::string>& known) const;
  std::optional<double> number(const std::string& field) const;
  /// A number > 0. Throws Error if it is missing.
  double positive(const std::string& field) const;
  std::optional<glm::dvec3> point(const std::string& field) const;
  glm::dvec3 needed_point(const std::string& field) const;
  /// The document holds rows; the result is `m[column][row]`, as in GLM.
  glm::dmat3 needed_matrix(const std::string& field) const;

  /// `item`: a value, such as an entry of a list. `field`: its name in messages.
  double finite(const std::string& field, const nlohmann::json& item) const;
  /// A whole number, 1 to `most`.
  int whole(const std::string& field, const nlohmann::json& item, int most) const;
};

}  // namespace gloam
