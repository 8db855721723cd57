// Fields of a JSON object, checked: a message names the file, the field and what is expected there.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/json_object.h"

namespace gloam::sets {

using Json = nlohmann::ordered_json;

/// The largest whole number of a field without a bound of its own.
inline constexpr int largest = std::numeric_limits<int>::max();

class JsonFields : public JsonObject {
 public:
  /// `place`: the object's path in the document, "items[3]"; empty for the document itself. Throws Error if it is no object.
  JsonFields(const Json& value, std::string file, std::string place);

  // Each throws Error for a value of another type, and all but those that return an optional for a missing one.
  std::string text(const char* key) const;
  double number(const char* key) const;  ///< finite
  int whole(const char* key, int low, int high) const;
  std::vector<JsonFields> objects(const char* key) const;
  std::vector<std::string> texts(const char* key) const;
  std::vector<int> wholes(const char* key, int low, int high) const;
  JsonFields object(const char* key) const;
  /// Throws Error for a key that is not `known`: a misspelt one would count as missing.
  void check_keys(const std::vector<std::string>& known) const;

  /// Throws Error: "FILE: FIELD is VALUE; EXPECTED".
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

 private:
  const Json& needed(const char* key) const;
  const Json& list(const char* key) const;
  int checked_whole(const Json& value, const std::string& key, int low, int high) const;
};

/// Parses a document. Throws Error that begins with `file`.
Json parse_document(const std::string& text, const std::string& file);

}  // namespace gloam::sets
