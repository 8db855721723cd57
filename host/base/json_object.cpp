#include "base/json_object.h"

namespace gloam {

const JsonObject::Json* JsonObject::find(const std::string& key) const {
  const auto found = value_.find(key);
  return found == value_.end() || found->is_null() ? nullptr : &*found;
}

std::string shown(const nlohmann::ordered_json& value) {
  constexpr size_t most = 40;
  const std::string text = value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() > most ? text.substr(0, most - 3) + "..." : text;
}

}  // namespace gloam
