// Memory that a command is going to take: worked out from headers, told and checked before anything is decoded.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options.h"

namespace gloam::cli {

/// Bytes, given whether the device shares the host's memory.
using MemoryNeed = std::function<unsigned long long(bool shares_memory)>;

/// Bytes at the peak of a command that computes on a device, which is asked for its kind only where that decides. Notes them
/// where they are more than 1 GiB. Throws Error where they are more than --limit-memory, or than there is; `ways_out`: what takes
/// less, in words.
unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, const std::string& device,
                                  const MemoryNeed& need, const std::string& ways_out);

/// The same of a command that uses no device.
unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, unsigned long long need,
                                  const std::string& ways_out);

/// What a process takes for itself, code and the libraries' own: without a device, and with one that has compiled kernels.
inline constexpr unsigned long long process_bytes = 48ull << 20, process_bytes_with_device = 160ull << 20;

/// "4G", "512M" or "1.5G": powers of 1024, from 1M to 1024T. Throws UsageError.
unsigned long long parse_memory(const std::string& text, const std::string& flag);

/// To read planes of a frame of one file or two, and of its history.
unsigned long long bytes_to_read(const FrameFiles& files, const std::vector<std::string>& planes);

/// Of `gloam run` with a plan on a frame that is read with these planes.
unsigned long long bytes_of_run(const FrameFiles& files, const std::vector<std::string>& planes, const Plan& plan,
                                bool shares_memory);

}  // namespace gloam::cli
