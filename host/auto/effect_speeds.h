// How fast settings of effects are on a device: measured once, kept in gloam's cache folder, one file for each device and driver.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "gloam/device.h"

namespace gloam {

/// Nanoseconds per pixel by settings: "evidence, medium, half". Kernels that change make a new table.
class EffectSpeeds {
 public:
  /// Reads what was kept; empty if nothing was, or the file is damaged.
  explicit EffectSpeeds(const DeviceInfo& info);

  std::optional<double> find(const std::string& settings) const;
  void set(const std::string& settings, double ns_per_pixel);
  /// Writes the table if it changed. Where nothing can be kept, the next process measures again.
  void keep() const;

 private:
  DeviceInfo info_;
  std::map<std::string, double> speeds_;
  bool is_changed_ = false;
};

}  // namespace gloam
