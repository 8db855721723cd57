// JSON from files that people and scripts write, and values of JSON that may be missing.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// JSON nested deeper than this is refused: readers recurse for each level.
inline constexpr int deepest_json = 200;

/// Parses JSON that people and scripts write. NaN and Infinity, which Python writes and JSON lacks, become strings of these names.
/// Throws Error that begins with `name`.
nlohmann::json json_of_text(const std::string& text, const std::string& name);

/// Parses standard JSON. Throws Error: "NAME: WHY: ...", `what` being what the text is not: "not glTF".
nlohmann::json standard_json(const std::string& text, const std::string& name, const std::string& what);

/// Parses standard JSON that programs write, its keys in their order. Throws Error that begins with `name`, also for an object of so many
/// keys that looking for one would take long.
nlohmann::ordered_json ordered_json_of_text(const std::string& text, const std::string& name);

/// Why the JSON library threw, without its number: "parse error at line 1, column 3: ...".
std::string reason_of(const nlohmann::json::exception& thrown);

/// A number; null where there is none, or one that JSON cannot hold.
nlohmann::ordered_json or_null(const std::optional<double>& number);
/// A text; null for an empty one.
nlohmann::ordered_json or_null(const std::string& text);

/// The median, the least and the greatest of times; 0 for none.
nlohmann::ordered_json milliseconds(const std::vector<double>& ms);

/// Whether a value is one of these strings.
bool is_nonfinite_literal(const nlohmann::json& value);

}  // namespace gloam
