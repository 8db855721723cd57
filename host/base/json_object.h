// Objects of a JSON document, read by key: messages name the file, the field, what stands there and what is expected.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Of a document, for messages.
struct JsonFile {
  std::string name;         ///< of the file
  std::string advice = {};  ///< what helps against a wrong field: "gloam bench makes it anew"; may be empty
  std::string document = "the document";  ///< what a message calls the whole of it
};

/// Refers to the document, which must outlive it. Functions whose names end in `_if` take a key that is missing or null, too; the others
/// throw Error then. All throw Error for a value of another type.
class JsonObject {
 public:
  using Json = nlohmann::ordered_json;

  /// `place`: the path in the document, "items[3]"; empty for the document itself. Throws Error if it is no object.
  JsonObject(const Json& value, JsonFile file, std::string place = "");

  const Json& json() const { return value_; }
  const std::string& file() const { return file_.name; }

  /// nullptr if it is missing or null.
  const Json* find(const std::string& key) const;
  /// "items[3].name"
  std::string path_of(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }

  std::string text(const std::string& key) const;
  std::string text_if(const std::string& key, const std::string& otherwise = "") const;
  /// One of `words`.
  std::string word_if(const std::string& key, const std::vector<std::string>& words,
                      const std::string& otherwise) const;
  bool flag(const std::string& key) const;
  bool flag_if(const std::string& key, bool otherwise = false) const;
  double number(const std::string& key) const;  ///< finite
  std::optional<double> number_if(const std::string& key) const;
  std::optional<double> number_if(const std::string& key, double least, double most) const;
  int whole(const std::string& key, int least = 0, int most = std::numeric_limits<int>::max()) const;
  std::vector<int> wholes(const std::string& key, int least = 0, int most = std::numeric_limits<int>::max()) const;
  std::vector<std::string> texts(const std::string& key) const;
  std::optional<std::vector<std::string>> texts_if(const std::string& key) const;
  std::vector<double> numbers_if(const std::string& key) const;
  JsonObject object(const std::string& key) const;
  JsonObject object_if(const std::string& key) const;  ///< without a key if it is missing
  std::vector<JsonObject> objects(const std::string& key) const;
  std::vector<JsonObject> objects_if(const std::string& key) const;

  /// Throws Error for a key that is not `known`: a misspelt one would count as missing.
  void check_keys(const std::vector<std::string>& known) const;

  /// Throws Error: "FILE: FIELD is VALUE; EXPECTED".
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

 private:
  const Json& needed(const std::string& key) const;
  /// Throws Error: "FILE: FIELD is VALUE, not EXPECTED; ADVICE".
  [[noreturn]] void not_a(const std::string& expected, const std::string& place, const Json& value) const;
  int checked_whole(double number, const std::string& key, int least, int most) const;
  template <typename Value>
  std::vector<Value> list(const std::string& key, const char* expected, bool (*is_one)(const Json&)) const;

  const Json& value_;
  JsonFile file_;
  std::string place_;
};

/// A value as it stands in its document, cut short.
std::string shown(const nlohmann::ordered_json& value);

}  // namespace gloam
