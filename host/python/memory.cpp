#include "python/memory.h"

#include "base/memory.h"
#include "gloam/error.h"

namespace gloam::python {

void check_memory(unsigned long long bytes, const std::string& name, const std::string& ways_out) {
  constexpr unsigned long long worth_looking = 64ull << 20;
  if (bytes < worth_looking) return;
  const unsigned long long available = available_memory();
  if (bytes <= available) return;
  throw Error("{}: would take about {} of memory, and {} are available; {}", name, memory_in_words(bytes),
              memory_in_words(available), ways_out);
}

}  // namespace gloam::python
