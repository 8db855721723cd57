#include "cli/shot/memory.h"

#include <algorithm>
#include <thread>

#include "base/memory.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

/// One frame in each thread's hands, and one that waits before each step.
PipelineSize wanted_size() {
  PipelineSize size;
  size.decoders = size.writers = std::clamp(std::thread::hardware_concurrency(), 1u, 2u);
  size.in_flight = size.decoders + size.writers + 3;
  return size;
}

}  // namespace

ShotMemory shot_memory(const std::string& name, unsigned long long own, unsigned long long beside,
                       const MemoryLimit& limit, const std::string& ways_out) {
  if (limit.bytes < beside + own)
    throw Error("{}: one frame of the shot would take about {} of memory, and {}; {}", name,
                memory_in_words(beside + own), limit.words, ways_out);
  ShotMemory memory{wanted_size(), 0, 0};
  memory.size.in_flight =
      size_t(std::min<unsigned long long>(memory.size.in_flight, (limit.bytes - beside) / std::max(own, 1ull)));
  memory.size.decoders = std::min(memory.size.decoders, memory.size.in_flight);
  memory.size.writers = std::min(memory.size.writers, memory.size.in_flight);
  memory.frame = (limit.bytes - beside) / memory.size.in_flight;
  memory.all = beside + memory.size.in_flight * own;
  return memory;
}

}  // namespace gloam::cli
