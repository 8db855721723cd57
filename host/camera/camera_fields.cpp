#include "camera/camera_fields.h"

#include <algorithm>
#include <cmath>

#include "base/json_text.h"
#include "gloam/error.h"

namespace gloam {

namespace {

using nlohmann::json;

}  // namespace

const json* CameraFields::find(const char* name) const {
  for (const json* level : {&view, &top}) {
    const auto field = level->find(name);
    if (field != level->end() && !field->is_null()) return &*field;
  }
  return nullptr;
}

void CameraFields::refuse(const std::string& name, const std::string& fault, const std::string& expected) const {
  const std::string field = name.substr(0, name.find('['));
  const bool at_top = !view.contains(field) && top.contains(field);
  throw Error("{}: {}{} {}; expected {}", file, at_top ? "" : prefix, name, fault, expected);
}

std::string type_in_words(const json& value) { return fmt::format("is of type {}", value.type_name()); }

std::optional<double> CameraFields::number(const char* name) const {
  const json* field = find(name);
  if (!field) return {};
  if (is_nonfinite_literal(*field)) refuse(name, "is not finite", "a number");
  if (!field->is_number()) refuse(name, type_in_words(*field), "a number");
  const double value = field->get<double>();
  if (!std::isfinite(value)) refuse(name, "is not finite", "a number");
  return value;
}

std::optional<double> CameraFields::positive(const char* name) const {
  const std::optional<double> value = number(name);
  if (value && !(*value > 0)) refuse(name, fmt::format("is {:g}", *value), "a number > 0");
  return value;
}

std::optional<std::string> CameraFields::text(const char* name) const {
  const json* field = find(name);
  if (!field) return {};
  if (!field->is_string()) refuse(name, type_in_words(*field), "a text");
  return field->get<std::string>();
}

std::optional<glm::dmat4> CameraFields::matrix(const char* name) const {
  const json* field = find(name);
  if (!field) return {};
  const auto is_row = [](const json& row) { return row.is_array() && row.size() == 4; };
  if (!field->is_array() || field->size() != 4 || !std::all_of(field->begin(), field->end(), is_row))
    refuse(name, "is not 4 rows of 4", "a 4x4 matrix of numbers, row by row");
  glm::dmat4 m(0.0);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const json& element = (*field)[row][column];
      const bool usable = element.is_number() && std::isfinite(element.get<double>());
      if (!usable)
        refuse(fmt::format("{}[{}][{}]", name, row, column),
               is_nonfinite_literal(element) ? "is not finite" : type_in_words(element), "a finite number");
      m[column][row] = element.get<double>();
    }
  return m;
}

}  // namespace gloam
