// Available memory, in bytes and in words.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// Bytes that a process can allocate without taking memory from another: what the kernel counts as available, or less if a
/// control group (a container, a job of a queue) allows less. A group's file cache counts as free. The largest number if nothing
/// is known. `root`: the folder of /proc and /sys.
unsigned long long available_memory(const std::filesystem::path& root = "/");

/// "4.2 GiB", "512 MiB"
std::string memory_in_words(unsigned long long bytes);

}  // namespace gloam
