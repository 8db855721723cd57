// What is known of devices before anything is measured on them: data/devices.json.
#pragma once

#include "gloam/device.h"

namespace gloam {

/// What the table says of a kind of device.
struct KnownDevice {
  Tuning tuning;
  bool keeps_kernels = false;  ///< the driver keeps compiled kernels on disk by itself
};

/// The first row of the table that fits a device. `vector_width`: floats per vector that the driver prefers.
KnownDevice known_device(const DeviceInfo& info, int vector_width);

}  // namespace gloam
