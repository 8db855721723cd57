#include "base/json_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include "base/statistics.h"
#include "base/words.h"
#include "gloam/error.h"

namespace gloam {
namespace {

std::string with_quoted_literals(const std::string& text) {
  const auto literal_at = [&](size_t i) -> std::string_view {
    for (std::string_view literal : {"NaN", "-Infinity", "Infinity"})
      if (text.compare(i, literal.size(), literal) == 0) return literal;
    return "";
  };
  std::string result;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (const std::string_view literal = quoted ? "" : literal_at(i); !literal.empty()) {
      result += fmt::format("\"{}\"", literal);
      i += literal.size() - 1;
      continue;
    }
    if (text[i] == '"') quoted = !quoted;
    result += text[i];
    if (quoted && text[i] == '\\' && i + 1 < text.size()) result += text[++i];
  }
  return result;
}

/// An ordered object looks through all of its keys for each one.
template <typename Json>
constexpr size_t most_keys = std::is_same_v<Json, nlohmann::ordered_json> ? 10'000 : std::numeric_limits<size_t>::max();

constexpr size_t longest_reason = 300;  ///< it quotes the text

template <typename Json>
Json parsed(const std::string& text, const std::string& name, const std::string& what) {
  using Event = nlohmann::detail::parse_event_t;
  std::vector<size_t> keys(deepest_json + 2);  ///< of the object at each level
  const auto is_allowed = [&](int depth, Event event, Json&) {
    if (depth > deepest_json)
      throw Error("{}: its JSON is nested more than {} levels deep, which is not read", name, deepest_json);
    if (event == Event::object_start) keys[size_t(depth) + 1] = 0;
    if (event == Event::key && ++keys[size_t(depth)] > most_keys<Json>)
      throw Error("{}: an object of its JSON has more than {} keys, which is not read", name, most_keys<Json>);
    return true;
  };
  try {
    return Json::parse(text, is_allowed);
  } catch (const nlohmann::json::exception& thrown) {
    throw Error("{}: {}: {}", name, what, shortened(reason_of(thrown), longest_reason));
  }
}

}  // namespace

std::string reason_of(const nlohmann::json::exception& thrown) {
  const std::string what = thrown.what();  // "[json.exception.parse_error.101] parse error at line 1, ..."
  const size_t end = what.starts_with("[") ? what.find("] ") : std::string::npos;
  return end == std::string::npos ? what : what.substr(end + 2);
}

nlohmann::json standard_json(const std::string& text, const std::string& name, const std::string& what) {
  return parsed<nlohmann::json>(text, name, what);
}

nlohmann::json json_of_text(const std::string& text, const std::string& name) {
  return parsed<nlohmann::json>(with_quoted_literals(text), name, "not readable as JSON");
}

nlohmann::ordered_json ordered_json_of_text(const std::string& text, const std::string& name) {
  return parsed<nlohmann::ordered_json>(text, name, "is not JSON");
}

bool is_nonfinite_literal(const nlohmann::json& value) {
  return value == "NaN" || value == "Infinity" || value == "-Infinity";
}

nlohmann::ordered_json or_null(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

nlohmann::ordered_json or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
}

nlohmann::ordered_json milliseconds(const std::vector<double>& ms) {
  if (ms.empty()) return {{"median", median(ms)}, {"min", 0}, {"max", 0}};
  const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
  return {{"median", median(ms)}, {"min", *least}, {"max", *most}};
}

}  // namespace gloam
