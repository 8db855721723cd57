// Memory of gloam auto on a frame in files.
#pragma once

#include "cli/flags/options.h"
#include "sequence/auto_files.h"

namespace gloam::cli {

/// Bytes at most, with the planes read.
unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory);

}  // namespace gloam::cli
