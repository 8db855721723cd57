#include "camera/display_fields.h"

#include <algorithm>
#include <cmath>

#include "base/json_text.h"
#include "base/lists.h"
#include "camera/camera_fields.h"
#include "gloam/error.h"

namespace gloam {

using glm::dmat3;
using glm::dvec3;
using nlohmann::json;

void DisplayFields::refuse(const std::string& field, const std::string& fault, const std::string& expected) const {
  throw Error("{}: {} {}; expected {}", file, name_of(field), fault, expected);
}

const json* DisplayFields::find(const std::string& field) const {
  const auto found = value.find(field);
  return found == value.end() || found->is_null() ? nullptr : &*found;
}

void DisplayFields::check_fields(const std::vector<std::string>& known) const {
  for (const auto& [field, unused] : value.items()) {
    if (!contains(known, field))
      throw Error("{}: {} is no field of a display{}; there are {}", file, name_of(field), suggestion(field, known),
                  enumerate(known));
  }
}

std::optional<DisplayFields> DisplayFields::object(const std::string& field,
                                                   const std::vector<std::string>& known) const {
  const json* value = find(field);
  if (!value) return {};
  if (!value->is_object()) refuse(field, type_in_words(*value), "an object with " + enumerate(known));
  DisplayFields result{file, name_of(field), *value};
  result.check_fields(known);
  return result;
}

DisplayFields DisplayFields::needed_object(const std::string& field, const std::vector<std::string>& known) const {
  const std::optional<DisplayFields> found = object(field, known);
  if (!found) refuse(field, "is missing", "an object with " + enumerate(known));
  return *found;
}

double DisplayFields::finite(const std::string& field, const json& item) const {
  if (is_nonfinite_literal(item)) refuse(field, "is not finite", "a number");
  if (!item.is_number()) refuse(field, type_in_words(item), "a number");
  const double number = item.get<double>();
  if (!std::isfinite(number) || std::abs(number) > largest_in_display)
    refuse(field, fmt::format("is {:g}", number), "a number of at most 1e12");
  return number;
}

std::optional<double> DisplayFields::number(const std::string& field) const {
  const json* value = find(field);
  return value ? std::optional(finite(field, *value)) : std::nullopt;
}

double DisplayFields::positive(const std::string& field) const {
  const std::optional<double> value = number(field);
  if (!value) refuse(field, "is missing", "a number > 0");
  if (!(*value > 0)) refuse(field, fmt::format("is {:g}", *value), "a number > 0");
  return *value;
}

int DisplayFields::whole(const std::string& field, const json& item, int most) const {
  const double number = finite(field, item);
  if (!(number >= 1 && number <= most) || number != std::floor(number))
    refuse(field, fmt::format("is {:g}", number), fmt::format("a whole number, 1 to {}", most));
  return int(number);
}

std::optional<dvec3> DisplayFields::point(const std::string& field) const {
  const json* value = find(field);
  if (!value) return {};
  if (!value->is_array() || value->size() != 3) refuse(field, "is no list of 3", "[x, y, z]");
  dvec3 result;
  for (int i = 0; i < 3; ++i) result[i] = finite(fmt::format("{}[{}]", field, i), (*value)[size_t(i)]);
  return result;
}

dvec3 DisplayFields::needed_point(const std::string& field) const {
  const std::optional<dvec3> found = point(field);
  if (!found) refuse(field, "is missing", "[x, y, z]");
  return *found;
}

dmat3 DisplayFields::needed_matrix(const std::string& field) const {
  const json* value = find(field);
  const auto is_row = [](const json& row) { return row.is_array() && row.size() == 3; };
  if (!value) refuse(field, "is missing", "3 rows of 3 numbers");
  if (!value->is_array() || value->size() != 3 || !std::all_of(value->begin(), value->end(), is_row))
    refuse(field, "is not 3 rows of 3", "3 rows of 3 numbers");
  dmat3 m;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      m[column][row] = finite(fmt::format("{}[{}][{}]", field, row, column), (*value)[size_t(row)][size_t(column)]);
  return m;
}

}  // namespace gloam
