// A time in milliseconds as a flag's value.
#pragma once

#include <string>

#include "flags/typed.h"

namespace gloam::cli {

/// Milliseconds of what `parse_time` reads: "30ms", "0.03s", "500us".
inline double parse_budget(const std::string& text, const std::string& flag) { return 1e3 * parse_time(text, flag); }

}  // namespace gloam::cli
