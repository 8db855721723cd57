// How fast options are on a device: measured once, kept in gloam's cache folder, one file for each device and driver.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"

namespace gloam {

/// What a time is of: views of so many pixels each.
struct FrameSize {
  double pixels = 0;
  double views = 1;
};
FrameSize size_of(const Frame& frame);

/// The time of an option on one view.
struct MeasuredTime {
  double pixels = 0, ms = 0;
};

/// What passes take to start, whatever they compute, and what each pixel takes.
struct TimeParts {
  double fixed_ms = 0, ns_per_pixel = 0;
  double ms(const FrameSize& size) const { return size.views * (fixed_ms + 1e-6 * ns_per_pixel * size.pixels); }
};

/// The parts that fit measured times best, in shares of each. However noisy these are, no part is negative, and the pixels of the largest image
/// have a tenth of its time at least. Of one size alone: all of its time is the pixels'.
TimeParts parts_of(const std::vector<MeasuredTime>& times);

/// Times by the label of an option: "evidence, medium, half". Kernels that change make a new table.
class OptionSpeeds {
 public:
  /// Reads what was kept; empty if nothing was, or the file is damaged or has another form.
  explicit OptionSpeeds(const DeviceInfo& info);

  /// Whether the time on a frame of this size can be told: from two sizes at least, the larger of which has a sixteenth of its pixels or more.
  bool knows(const std::string& label, const FrameSize& size) const;
  /// Milliseconds; 0 where nothing was measured.
  double expected_ms(const std::string& label, const FrameSize& size) const;
  /// Takes the place of what was measured on images of about that size.
  void add(const std::string& label, const FrameSize& size, double ms);
  /// Writes the table if it changed. Where nothing can be kept, the next process measures again.
  void keep() const;

 private:
  DeviceInfo info_;
  std::map<std::string, std::map<int, MeasuredTime>> times_;  ///< by label and by powers of two of pixels
  bool is_changed_ = false;
};

}  // namespace gloam
