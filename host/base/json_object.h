// An object of a JSON document with its place there, for readers whose messages name file and field.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gloam {

/// Refers to the document, which must outlive it. Readers derive from it and say what they expect in words of their own.
class JsonObject {
 public:
  using Json = nlohmann::ordered_json;

  /// `place`: the path in the document, "items[3]"; empty for the document itself.
  JsonObject(const Json& value, std::string file, std::string place)
      : value_(value), file_(std::move(file)), place_(std::move(place)) {}

  const Json& json() const { return value_; }
  const std::string& file() const { return file_; }

  /// nullptr if it is missing or null.
  const Json* find(const std::string& key) const;
  /// "items[3].name"
  std::string path_of(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }
  /// "items[3]"; of the document `what`.
  std::string place_or(const std::string& what) const { return place_.empty() ? what : place_; }

 private:
  const Json& value_;
  std::string file_, place_;
};

/// A value as it stands in its document, cut short.
std::string shown(const nlohmann::ordered_json& value);

}  // namespace gloam
