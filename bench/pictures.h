// Pictures of the measured images, for the report.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"

namespace gloam::bench {

/// A name that is safe in files and addresses: letters, digits, '.', '_' and '-' stay, '+' becomes "plus", any run of other
/// characters one '-'.
std::string file_name(const std::string& name);

/// Values of 0 to 1 as an 8-bit PNG of grey and alpha, background transparent. Throws Error naming `path`.
void write_share(const std::filesystem::path& path, const Channel& values, const Channel& depth);

}  // namespace gloam::bench
