#include "set/json_fields.h"

#include <cmath>

#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"

namespace gloam::sets {
JsonFields::JsonFields(const Json& value, std::string file, std::string place)
    : JsonObject(value, std::move(file), std::move(place)) {
  if (!value.is_object())
    throw Error("{}: {} is {}; it must be an object", this->file(), place_or("the document"), shown(value));
}

void JsonFields::refuse(const std::string& key, const std::string& expected) const {
  const auto found = json().find(key);
  if (found == json().end()) throw Error("{}: {} is missing; {}", file(), path_of(key), expected);
  throw Error("{}: {} is {}; {}", file(), path_of(key), shown(*found), expected);
}

const Json& JsonFields::needed(const char* key) const {
  const Json* value = find(key);
  if (!value) refuse(key, "it must be given");
  return *value;
}

std::string JsonFields::text(const char* key) const {
  const Json& value = needed(key);
  if (!value.is_string()) refuse(key, "it must be a text");
  return value.get<std::string>();
}

double JsonFields::number(const char* key) const {
  const Json& value = needed(key);
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(key, "it must be a number");
  return value.get<double>();
}

int JsonFields::checked_whole(const Json& value, const std::string& key, int low, int high) const {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= low && number <= high && number == std::floor(number)))
    refuse(key, fmt::format("whole numbers from {} to {} are allowed", low, high));
  return int(number);
}

int JsonFields::whole(const char* key, int low, int high) const { return checked_whole(needed(key), key, low, high); }

const Json& JsonFields::list(const char* key) const {
  const Json& value = needed(key);
  if (!value.is_array()) refuse(key, "it must be a list");
  return value;
}

std::vector<JsonFields> JsonFields::objects(const char* key) const {
  std::vector<JsonFields> all;
  const Json& values = list(key);
  for (size_t i = 0; i < values.size(); ++i)
    all.emplace_back(values[i], file(), fmt::format("{}[{}]", path_of(key), i));
  return all;
}

std::vector<std::string> JsonFields::texts(const char* key) const {
  std::vector<std::string> all;
  for (const Json& value : list(key)) {
    if (!value.is_string()) refuse(key, "it must be a list of texts");
    all.push_back(value.get<std::string>());
  }
  return all;
}

std::vector<int> JsonFields::wholes(const char* key, int low, int high) const {
  std::vector<int> all;
  for (const Json& value : list(key)) all.push_back(checked_whole(value, key, low, high));
  return all;
}

JsonFields JsonFields::object(const char* key) const { return JsonFields(needed(key), file(), path_of(key)); }

void JsonFields::check_keys(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : json().items()) {
    if (!contains(known, key))
      throw Error("{}: {} is not known{}; there are {}", file(), path_of(key), suggestion(key, known),
                  enumerate(known));
  }
}

Json parse_document(const std::string& text, const std::string& file) { return Json(json_of_text(text, file)); }

}  // namespace gloam::sets
