// What `gloam doctor` found on a device, kept in gloam's cache folder: one file for each device and driver.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"

namespace gloam {

struct DeviceRecord {
  bool held = false;             ///< all self-tests
  std::string day;               ///< "2026-05-17"
  std::string kernels;           ///< hash of the kernels that were tested (`hash_of_kernels`)
  std::optional<Tuning> tuning;  ///< none: not measured
  std::optional<double> cold_ms,
      warm_ms;                        ///< from the start of a process to the first image, without and with kept kernels
  std::vector<std::string> failures;  ///< one sentence for each self-test that did not hold
};

/// A device with its driver, as text, by which what is known of it is found again.
std::string key_of(const DeviceInfo& info);

/// The file in a folder of gloam's cache for what is known of a device with its driver; empty if nothing can be kept.
std::filesystem::path path_in_cache(const std::string& folder, const DeviceInfo& info);

/// The record of a device with the same driver; none if it was never examined, or the file is damaged.
std::optional<DeviceRecord> find_record(const DeviceInfo& info);

/// Keeps a record. Throws Error where no file can be written.
void keep_record(const DeviceInfo& info, const DeviceRecord& record);

/// Sixteen digits that change with any kernel.
std::string hash_of_kernels();

}  // namespace gloam
