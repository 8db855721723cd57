#include "base/json_text.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/statistics.h"
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

}  // namespace

nlohmann::json parse_shallow(const std::string& text, const std::string& name) {
  const auto is_shallow = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > deepest_json)
      throw Error("{}: its JSON is nested more than {} levels deep, which is not read", name, deepest_json);
    return true;
  };
  return nlohmann::json::parse(text, is_shallow);
}

nlohmann::json json_of_text(const std::string& text, const std::string& name) {
  try {
    return parse_shallow(with_quoted_literals(text), name);
  } catch (const nlohmann::json::exception& e) {
    const std::string_view what = e.what();  // "[json.exception.parse_error.101] parse error at line 1, ..."
    throw Error("{}: not readable as JSON: {}", name, what.substr(what.find("] ") + 2));
  }
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
