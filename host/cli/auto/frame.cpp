#include "cli/auto/frame.h"

#include "cli/flags/memory.h"

namespace gloam::cli {

unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory) {
  return process_bytes_with_device + bytes_to_read(planned.files, planned.planes) +
         bytes_beside_frame(planned, shares_memory);
}

}  // namespace gloam::cli
