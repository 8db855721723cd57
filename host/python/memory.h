// Memory that a call will take, looked at before it is taken.
#pragma once

#include <string>

namespace gloam::python {

/// Throws Error if fewer bytes are available. `ways_out`: advice for less, in words.
void check_memory(unsigned long long bytes, const std::string& name, const std::string& ways_out);

}  // namespace gloam::python
