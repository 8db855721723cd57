// The text of a pass's kernel.
#pragma once

#include <string>

namespace gloam::cli {

/// Prints the text that the compiler gets for a pass, by its name ("gtao/estimate"), of its technique's default plan for a frame
/// that has every plane. Throws UsageError, with the nearest name, for an unknown one.
void print_kernel(const std::string& label);

}  // namespace gloam::cli
