// How much memory there is, in bytes and in words.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// Bytes that a process can take without another losing what it holds: what the kernel counts as available, or less where a control
/// group (a container, a job of a queue) allows less. What such a group holds of files counts as free. The largest number where
/// nothing tells. `root`: where /proc and /sys are.
unsigned long long available_memory(const std::filesystem::path& root = "/");

/// "4.2 GiB", "512 MiB"
std::string memory_in_words(unsigned long long bytes);

}  // namespace gloam
