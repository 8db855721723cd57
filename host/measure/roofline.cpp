#include "measure/roofline.h"

#include <nlohmann/json.hpp>

#include "technique/data_files.h"

namespace gloam::bench {

std::optional<PassCount> count_of(const std::string& technique, const std::string& preset, const std::string& pass) {
  static const nlohmann::json counted = nlohmann::json::parse(data_files().at("operations.json")).at("techniques");
  const nlohmann::json* at = &counted;
  for (const std::string& key : {technique, preset, pass}) {
    const auto found = at->find(key);
    if (found == at->end()) return {};
    at = &*found;
  }
  return PassCount{at->at("operations"),   at->at("loads"),        at->at("bytes_loaded"),
                   at->at("bytes_stored"), at->at("instructions"), at->at("float_instructions")};
}

}  // namespace gloam::bench
