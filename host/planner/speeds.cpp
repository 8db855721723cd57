#include "planner/speeds.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"
#include "run/device_record.h"
#include "run/kept_folders.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path path_of(const DeviceInfo& info) { return path_in_cache("speeds", info); }

}  // namespace

OptionSpeeds::OptionSpeeds(const DeviceInfo& info) : info_(info) {
  const fs::path path = path_of(info);
  if (path.empty()) return;
  const std::optional<std::string> text = kept_text(path);
  if (!text) return;
  try {
    const Json document = ordered_json_of_text(*text, path.string());
    if (document.at("device") != key_of(info) || document.at("kernels") != hash_of_kernels()) return;
    for (const auto& [label, ns] : document.at("ns_per_pixel").items())
      if (ns.is_number() && double(ns) > 0) speeds_[label] = ns;
  } catch (const Json::exception&) {
    speeds_.clear();
  } catch (const Error&) {
    speeds_.clear();
  }
}

std::optional<double> OptionSpeeds::find(const std::string& label) const {
  const auto found = speeds_.find(label);
  return found == speeds_.end() ? std::nullopt : std::optional(found->second);
}

void OptionSpeeds::set(const std::string& label, double ns_per_pixel) {
  if (!(ns_per_pixel > 0) || !std::isfinite(ns_per_pixel)) return;
  speeds_[label] = ns_per_pixel;
  is_changed_ = true;
}

void OptionSpeeds::keep() const {
  const fs::path path = path_of(info_);
  if (!is_changed_ || path.empty()) return;
  const Json document = {{"device", key_of(info_)}, {"kernels", hash_of_kernels()}, {"ns_per_pixel", speeds_}};
  const std::string text = document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  make_way(path);
  try {
    write_atomically(
        path, [&](NewFile& file) { file.append(text); }, FileFor::cache);
  } catch (const Error&) {
    return;
  }
}

}  // namespace gloam
