// How fast options are on a device: measured once, kept in gloam's cache folder, one file for each device and driver.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "gloam/device.h"

namespace gloam {

/// Nanoseconds per pixel by the label of an option: "evidence, medium, half". Kernels that change make a new table.
class OptionSpeeds {
 public:
  /// Reads what was kept; empty if nothing was, or the file is damaged.
  explicit OptionSpeeds(const DeviceInfo& info);

  std::optional<double> find(const std::string& label) const;
  void set(const std::string& label, double ns_per_pixel);
  /// Writes the table if it changed. Where nothing can be kept, the next process measures again.
  void keep() const;

 private:
  DeviceInfo info_;
  std::map<std::string, double> speeds_;
  bool is_changed_ = false;
};

}  // namespace gloam
