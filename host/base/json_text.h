// JSON from files that people and scripts write.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gloam {

/// Deeper texts are refused: what goes through them calls itself for each level.
inline constexpr int deepest_json = 200;

/// Parses a text of JSON proper. Throws Error that begins with `name` for one that is nested too deep, and what the parser
/// throws.
nlohmann::json parse_shallow(const std::string& text, const std::string& name);

/// Parses a text that people and scripts write. NaN and Infinity, which Python writes and JSON does not know, become texts of these names. Throws Error
/// that begins with `name`.
nlohmann::json json_of_text(const std::string& text, const std::string& name);

/// Whether a value is one of these texts, for which no number can be had.
bool is_nonfinite_literal(const nlohmann::json& value);

}  // namespace gloam
