#include "base/json_object.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/error.h"

namespace gloam {
namespace {

const JsonObject::Json no_object = JsonObject::Json::object();

bool is_text(const JsonObject::Json& value) { return value.is_string(); }
bool is_number(const JsonObject::Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

}  // namespace

JsonObject::JsonObject(const Json& value, JsonFile file, std::string place)
    : value_(value), file_(std::move(file)), place_(std::move(place)) {
  if (!value.is_object()) not_a("an object", place_.empty() ? file_.document : place_, value);
}

const JsonObject::Json* JsonObject::find(const std::string& key) const {
  const auto found = value_.find(key);
  return found == value_.end() || found->is_null() ? nullptr : &*found;
}

void JsonObject::not_a(const std::string& expected, const std::string& place, const Json& value) const {
  throw Error("{}: {} is {}, not {}{}{}", file(), place, shown(value), expected, file_.advice.empty() ? "" : "; ",
              file_.advice);
}

void JsonObject::refuse(const std::string& key, const std::string& expected) const {
  const auto found = value_.find(key);
  throw Error("{}: {} is {}; {}", file(), path_of(key), found == value_.end() ? "missing" : shown(*found), expected);
}

const JsonObject::Json& JsonObject::needed(const std::string& key) const {
  const Json* value = find(key);
  if (!value)
    throw Error("{}: {} is missing; {}", file(), path_of(key),
                file_.advice.empty() ? "it must be given" : file_.advice);
  return *value;
}

std::string JsonObject::text(const std::string& key) const { return needed(key), text_if(key); }

std::string JsonObject::text_if(const std::string& key, const std::string& otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!is_text(*value)) not_a("a text", path_of(key), *value);
  return value->get<std::string>();
}

std::string JsonObject::word_if(const std::string& key, const std::vector<std::string>& words,
                                const std::string& otherwise) const {
  const std::string word = text_if(key, otherwise);
  if (find(key) && !contains(words, word)) refuse(key, enumerate(words) + suggestion(word, words) + " is allowed");
  return word;
}

bool JsonObject::flag(const std::string& key) const { return needed(key), flag_if(key); }

bool JsonObject::flag_if(const std::string& key, bool otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_boolean()) refuse(key, "true or false is allowed");
  return value->get<bool>();
}

double JsonObject::number(const std::string& key) const { return needed(key), *number_if(key); }

std::optional<double> JsonObject::number_if(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return {};
  if (!is_number(*value)) not_a("a number", path_of(key), *value);
  return value->get<double>();
}

std::optional<double> JsonObject::number_if(const std::string& key, double least, double most) const {
  const Json* value = find(key);
  if (!value) return {};
  if (!is_number(*value) || value->get<double>() < least || value->get<double>() > most)
    refuse(key, fmt::format("a number from {:g} to {:g} is allowed", least, most));
  return value->get<double>();
}

int JsonObject::checked_whole(double number, const std::string& key, int least, int most) const {
  if (!(number >= least && number <= most && number == std::floor(number)))
    refuse(key, fmt::format("whole numbers from {} to {} are allowed", least, most));
  return int(number);
}

int JsonObject::whole(const std::string& key, int least, int most) const {
  const Json& value = needed(key);
  return checked_whole(value.is_number() ? value.get<double>() : std::nan(""), key, least, most);
}

std::vector<int> JsonObject::wholes(const std::string& key, int least, int most) const {
  std::vector<int> all;
  needed(key);
  for (const double number : numbers_if(key)) all.push_back(checked_whole(number, key, least, most));
  return all;
}

template <typename Value>
std::vector<Value> JsonObject::list(const std::string& key, const char* expected, bool (*is_one)(const Json&)) const {
  const Json* value = find(key);
  if (!value) return {};
  if (!value->is_array() || !std::all_of(value->begin(), value->end(), is_one)) not_a(expected, path_of(key), *value);
  return value->get<std::vector<Value>>();
}

std::vector<std::string> JsonObject::texts(const std::string& key) const { return needed(key), *texts_if(key); }

std::optional<std::vector<std::string>> JsonObject::texts_if(const std::string& key) const {
  if (!find(key)) return {};
  return list<std::string>(key, "a list of texts", is_text);
}

std::vector<double> JsonObject::numbers_if(const std::string& key) const {
  return list<double>(key, "a list of numbers", is_number);
}

JsonObject JsonObject::object(const std::string& key) const { return needed(key), object_if(key); }

JsonObject JsonObject::object_if(const std::string& key) const {
  const Json* value = find(key);
  return JsonObject(value ? *value : no_object, file_, path_of(key));
}

std::vector<JsonObject> JsonObject::objects(const std::string& key) const { return needed(key), objects_if(key); }

std::vector<JsonObject> JsonObject::objects_if(const std::string& key) const {
  std::vector<JsonObject> all;
  const Json* value = find(key);
  if (!value) return all;
  if (!value->is_array()) not_a("a list", path_of(key), *value);
  for (size_t i = 0; i < value->size(); ++i)
    all.emplace_back((*value)[i], file_, fmt::format("{}[{}]", path_of(key), i));
  return all;
}

void JsonObject::check_keys(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : value_.items()) {
    if (!contains(known, key))
      throw Error("{}: no key '{}'{}; {} are allowed", file(), path_of(key), suggestion(key, known), enumerate(known));
  }
}

std::string shown(const nlohmann::ordered_json& value) {
  constexpr size_t most = 40;
  const std::string text = value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() > most ? text.substr(0, most - 3) + "..." : text;
}

}  // namespace gloam
