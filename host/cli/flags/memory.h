// Memory that a command will take: calculated from headers, noted and checked before anything is decoded.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "shot/memory.h"

namespace gloam::cli {

/// Bytes, given whether the device shares the host's memory.
using MemoryNeed = std::function<unsigned long long(bool shares_memory)>;

/// Peak memory, bytes, of a command that computes on a device. Opens the device only if the need depends on its kind. Adds a note
/// for more than 1 GiB. Throws Error for more than --limit-memory or than the machine has; `ways_out`: advice for less, in words.
unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, const std::string& device,
                                  const MemoryNeed& need, const std::string& ways_out);

/// As above, for a command that uses no device.
unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, unsigned long long need,
                                  const std::string& ways_out);

/// By --limit-memory, else what is available. `memory`: --memory of a shot, where that is less.
MemoryLimit limit_of(const FrameFlags& flags, const std::string& memory = "");

/// "4G", "512M" or "1.5G": powers of 1024, from 1M to 1024T. Throws UsageError.
unsigned long long parse_memory(const std::string& text, const std::string& flag);

}  // namespace gloam::cli
