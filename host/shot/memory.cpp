#include "shot/memory.h"

#include <algorithm>
#include <thread>

#include "base/memory.h"
#include "gloam/error.h"
#include "gloam/run.h"

namespace gloam {
namespace {

/// One frame in each thread's hands, and one that waits before each step.
PipelineSize wanted_size() {
  PipelineSize size;
  size.decoders = size.writers = std::clamp(std::thread::hardware_concurrency(), 1u, 2u);
  size.in_flight = size.decoders + size.writers + 3;
  return size;
}

}  // namespace

unsigned long long bytes_to_read(const FrameFiles& files, const std::vector<std::string>& planes) {
  unsigned long long bytes = 0;
  for (const FrameFile& file : files.files()) bytes += file.bytes_to_read(planes);
  if (files.history() && has_history(planes))
    bytes += files.history()->file().bytes_to_read(files.history()->planes_of_file());
  return bytes;
}

unsigned long long bytes_of_run(const FrameFiles& files, const std::vector<std::string>& planes, const Plan& plan,
                                bool shares_memory) {
  const Layout layout(files.window().width(), files.window().height());
  return process_bytes_with_device + bytes_to_read(files, planes) +
         bytes_beside_frame(plan, layout, files.views().size(), shares_memory);
}

MemoryLimit available_limit() {
  const unsigned long long bytes = available_memory();
  return {bytes, fmt::format("{} are available", memory_in_words(bytes))};
}

ShotMemory shot_memory(const std::string& name, unsigned long long own, unsigned long long beside,
                       const MemoryLimit& limit, const std::string& ways_out) {
  if (limit.bytes < beside + own)
    throw Error("{}: one frame of the shot would take about {} of memory, and {}; {}", name,
                memory_in_words(beside + own), limit.words, ways_out);
  ShotMemory memory{.size = wanted_size()};
  memory.size.in_flight =
      size_t(std::min<unsigned long long>(memory.size.in_flight, (limit.bytes - beside) / std::max(own, 1ull)));
  memory.size.decoders = std::min(memory.size.decoders, memory.size.in_flight);
  memory.size.writers = std::min(memory.size.writers, memory.size.in_flight);
  memory.frame = (limit.bytes - beside) / memory.size.in_flight;
  memory.all = beside + memory.size.in_flight * own;
  return memory;
}

}  // namespace gloam
