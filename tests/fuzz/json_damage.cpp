#include "fuzz/json_damage.h"

#include <nlohmann/json.hpp>

#include "fuzz/target.h"
#include "fuzz/words.h"

namespace gloam::fuzz {
namespace {

using Json = nlohmann::ordered_json;

void collect(Json& value, std::vector<Json*>& values) {
  values.push_back(&value);
  if (value.is_structured())
    for (Json& child : value) collect(child, values);
}

Json& any_value(Json& document, Random& random) {
  std::vector<Json*> values;
  collect(document, values);
  return *values[random.below(values.size())];
}

Json odd_value(const std::vector<std::string>& words, Random& random) {
  switch (random.below(8)) {
    case 0:
      return random.pick<Json>({nullptr, true, false, Json::array(), Json::object(), "NaN", "Infinity", "-Infinity"});
    case 1:
      return odd_whole_number(random);
    case 2:
      return random.pick(words);
    case 3:
      return Json::array({0, 0, 1});
    case 4:
      return random.between(-1000, 1000) / 100.0;
    default:
      return odd_number(random);  // null if it is not finite
  }
}

/// Replaces a member of an object or list by another of its members.
void change_children(Json& value, const std::vector<std::string>& words, Random& random) {
  if (value.is_array()) {
    if (random.one_in(2) || value.empty())
      value.push_back(value.empty() ? odd_value(words, random) : Json(value[0]));
    else
      value.erase(random.below(value.size()));
    return;
  }
  if (!value.is_object()) return;
  auto child = value.begin();
  if (!value.empty()) std::advance(child, std::ptrdiff_t(random.below(value.size())));
  if (random.one_in(2) || value.empty()) {
    value[random.pick(words)] = odd_value(words, random);
  } else if (random.one_in(2)) {
    const Json moved = child.value();
    value[random.pick(words)] = moved;
  } else {
    value.erase(child.key());
  }
}

void scale_number(Json& value, Random& random) {
  if (value.is_number())
    value = value.get<double>() * random.pick({-1.0, 0.5, 2.0, 1e-3, 1e3, 1e-9, 1e9, 1.0001, 0.9999});
}

std::string with_literals(std::string text, Random& random) {
  if (random.one_in(2)) return text;
  for (const std::string literal : {"-Infinity", "Infinity", "NaN"})
    for (size_t at = 0; (at = text.find('"' + literal + '"', at)) != std::string::npos;)
      text.replace(at, literal.size() + 2, literal);
  return text;
}

void change(Json& document, const std::vector<std::string>& starts, const std::vector<std::string>& words,
            Random& random) {
  Json& value = any_value(document, random);
  switch (random.below(5)) {
    case 0:
      value = odd_value(words, random);
      return;
    case 1:
      return change_children(value, words, random);
    case 2:
    case 3: {
      Json* number = &value;
      for (int tries = 0; tries < 8 && !number->is_number(); ++tries) number = &any_value(document, random);
      return scale_number(*number, random);
    }
    default: {
      Json other = Json::parse(random.pick(starts), nullptr, false);
      const Json taken = any_value(random.one_in(2) ? other : document, random);
      value = taken;
    }
  }
}

}  // namespace

std::string damaged_json(const std::string& text, const std::vector<std::string>& starts,
                         const std::vector<std::string>& words, Random& random) {
  if (random.one_in(64)) return random.pick(starts);
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded() || random.one_in(6)) return mutated(text);
  change(document, starts, words, random);
  return with_literals(document.dump(random.one_in(8) ? 1 : -1, ' ', false, Json::error_handler_t::replace), random);
}

}  // namespace gloam::fuzz
