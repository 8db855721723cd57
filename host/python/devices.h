// OpenCL devices that calls share.
#pragma once

#include <memory>
#include <string>

#include "gloam/device.h"

namespace gloam::python {

/// The device that a text stands for, opened at its first use and kept with its kernels as long as the process lives. Needs no
/// interpreter lock. Throws Error as `Device` does.
std::shared_ptr<Device> shared_device(const std::string& text);

}  // namespace gloam::python
