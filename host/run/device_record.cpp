#include "run/device_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/hash.h"
#include "base/json_text.h"
#include "run/kept_folders.h"
#include "run/tuning.h"
#include "technique/kernel_sources.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path path_of(const DeviceInfo& info) { return path_in_cache("devices", info); }

std::optional<double> number_of(const Json& document, const char* name) {
  if (!document.at(name).is_number()) return {};
  return document.at(name).get<double>();
}

Json document_of(const DeviceInfo& info, const DeviceRecord& record) {
  Json tuning;
  if (record.tuning) tuning = gloam::document_of(*record.tuning);
  return {{"device", key_of(info)},
          {"day", record.day},
          {"kernels", record.kernels},
          {"held", record.held},
          {"failures", record.failures},
          {"tuning", tuning},
          {"cold_ms", or_null(record.cold_ms)},
          {"warm_ms", or_null(record.warm_ms)}};
}

}  // namespace

std::string key_of(const DeviceInfo& info) { return info.platform + "; " + info.name + "; " + info.driver; }

fs::path path_in_cache(const std::string& folder, const DeviceInfo& info) {
  if (cache_folder().folder.empty()) return {};
  return cache_folder().folder / folder / fmt::format("{:016x}.json", hash_of(key_of(info)));
}

std::optional<DeviceRecord> find_record(const DeviceInfo& info) {
  const fs::path path = path_of(info);
  if (path.empty()) return {};
  const std::optional<std::string> text = kept_text(path);
  if (!text) return {};
  try {
    const Json document = ordered_json_of_text(*text, path.string());
    if (document.at("device") != key_of(info)) return {};
    DeviceRecord record;
    record.held = document.at("held");
    record.day = document.at("day");
    record.kernels = document.at("kernels");
    record.failures = document.at("failures").get<std::vector<std::string>>();
    record.tuning = tuning_in(document.at("tuning"), info.usual);
    record.cold_ms = number_of(document, "cold_ms");
    record.warm_ms = number_of(document, "warm_ms");
    return record;
  } catch (const Json::exception&) {
    return {};
  } catch (const Error&) {
    return {};
  }
}

void keep_record(const DeviceInfo& info, const DeviceRecord& record) {
  const fs::path path = path_of(info);
  if (path.empty()) throw Error("the result cannot be kept: {}", cache_folder().why_elsewhere);
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  make_way(path);
  const std::string text = document_of(info, record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  write_atomically(
      path, [&](NewFile& file) { file.append(text); }, FileFor::cache);
}

std::string hash_of_kernels() {
  uint64_t hash = hash_of("");
  for (const auto& [file, text] : kernel_sources()) hash = hash_of(text, hash_of(file, hash));
  return fmt::format("{:016x}", hash);
}

}  // namespace gloam
