#include "run/known_devices.h"

#include <nlohmann/json.hpp>

#include "technique/data_files.h"

namespace gloam {

KnownDevice known_device(const DeviceInfo& info, int vector_width) {
  static const nlohmann::json table = nlohmann::json::parse(data_files().at("devices.json"));
  for (const nlohmann::json& row : table) {
    const bool fits = row.value("platform", info.platform) == info.platform &&
                      row.value("type", info.type) == info.type && row.value("vector", 0) <= vector_width;
    if (fits) return {{row.at("lanes"), row.at("group")}, row.value("keeps_kernels", false)};
  }
  return {};
}

}  // namespace gloam
