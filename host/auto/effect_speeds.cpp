#include "auto/effect_speeds.h"

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

EffectSpeeds::EffectSpeeds(const DeviceInfo& info) : info_(info) {
  const fs::path path = path_of(info);
  if (path.empty()) return;
  const std::optional<std::string> text = kept_text(path);
  if (!text) return;
  try {
    const Json document = ordered_json_of_text(*text, path.string());
    if (document.at("device") != key_of(info) || document.at("kernels") != hash_of_kernels()) return;
    for (const auto& [settings, ns] : document.at("ns_per_pixel").items())
      if (ns.is_number() && double(ns) > 0) speeds_[settings] = ns;
  } catch (const Json::exception&) {
    speeds_.clear();
  } catch (const Error&) {
    speeds_.clear();
  }
}

std::optional<double> EffectSpeeds::find(const std::string& settings) const {
  const auto found = speeds_.find(settings);
  return found == speeds_.end() ? std::nullopt : std::optional(found->second);
}

void EffectSpeeds::set(const std::string& settings, double ns_per_pixel) {
  if (!(ns_per_pixel > 0) || !std::isfinite(ns_per_pixel)) return;
  speeds_[settings] = ns_per_pixel;
  is_changed_ = true;
}

void EffectSpeeds::keep() const {
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
