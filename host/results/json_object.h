// Reading bench.json: entries by name, and messages that say where in the file a wrong one is.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/json_object.h"
#include "gloam/error.h"
#include "results/measurements.h"

namespace gloam::report {

/// An object of the file.
class Object : public JsonObject {
 public:
  Object(const Json& value, std::string file, std::string place)
      : JsonObject(value, std::move(file), std::move(place)) {
    if (!value.is_object()) fail(place_or("the document"), value, "an object");
  }

  /// Empty if it is null or missing.
  std::string text(const char* key) const {
    const Json* value = find(key);
    if (!value) return "";
    if (!value->is_string()) fail(path_of(key), *value, "a text");
    return value->get<std::string>();
  }

  Number number(const char* key) const {
    const Json* value = find(key);
    if (!value) return {};
    if (!value->is_number() || !std::isfinite(value->get<double>())) fail(path_of(key), *value, "a number");
    return value->get<double>();
  }

  std::string needed_text(const char* key) const {
    if (!find(key)) missing(key);
    return text(key);
  }

  double needed_number(const char* key) const {
    if (!find(key)) missing(key);
    return *number(key);
  }

  size_t needed_count(const char* key) const {
    constexpr double most = 1e9;
    const double value = needed_number(key);
    if (!(value >= 0 && value <= most)) fail(path_of(key), *find(key), "a count");
    return size_t(value);
  }

  Object object(const char* key) const {
    const Json* value = find(key);
    return Object(value ? *value : nothing, file(), path_of(key));
  }

  Object needed_object(const char* key) const {
    if (!find(key)) missing(key);
    return object(key);
  }

  std::vector<Object> list(const char* key) const {
    std::vector<Object> items;
    const Json* value = find(key);
    if (!value) return items;
    if (!value->is_array()) fail(path_of(key), *value, "a list");
    for (size_t i = 0; i < value->size(); ++i)
      items.emplace_back(value->at(i), file(), fmt::format("{}[{}]", path_of(key), i));
    return items;
  }

  std::vector<Object> needed_list(const char* key) const {
    if (!find(key)) missing(key);
    return list(key);
  }

  /// Empty if it is null or missing.
  std::optional<std::vector<std::string>> texts(const char* key) const {
    const Json* value = find(key);
    if (!value) return {};
    const bool are_texts =
        value->is_array() && std::all_of(value->begin(), value->end(), [](const Json& v) { return v.is_string(); });
    if (!are_texts) fail(path_of(key), *value, "a list of texts");
    return value->get<std::vector<std::string>>();
  }

  /// Empty if it is null or missing.
  std::vector<double> numbers(const char* key) const {
    const Json* value = find(key);
    if (!value) return {};
    const bool are_numbers =
        value->is_array() && std::all_of(value->begin(), value->end(), [](const Json& v) { return v.is_number(); });
    if (!are_numbers) fail(path_of(key), *value, "a list of numbers");
    return value->get<std::vector<double>>();
  }

  /// The two numbers of a size; empty if there is none.
  std::pair<Number, Number> size(const char* key) const {
    const Json* value = find(key);
    if (!value) return {};
    if (!value->is_array() || value->size() != 2 || !value->at(0).is_number() || !value->at(1).is_number())
      fail(path_of(key), *value, "a list of width and height");
    return {value->at(0).get<double>(), value->at(1).get<double>()};
  }

 private:
  static inline const Json nothing = Json::object();

  [[noreturn]] void fail(const std::string& place, const Json& value, const char* needed) const {
    throw Error("{}: {} is {}, not {}; remove the file, and gloam bench makes it anew", file(), place, shown(value),
                needed);
  }
  [[noreturn]] void missing(const char* key) const {
    throw Error("{}: {} is missing; remove the file, and gloam bench makes it anew", file(), path_of(key));
  }
};

}  // namespace gloam::report
