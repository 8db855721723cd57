// What a compiler says of a kernel that does not build.
#pragma once

#include <string>

namespace gloam {

/// The first error of a build log, "file:line: what" where the compiler names them; else its first line that says anything.
std::string first_error(const std::string& log);

/// One line of at most 300 characters: device, kernel, first error, and the file that holds the whole log, which is written below
/// `cache_folder`. No file is named where none can be written.
std::string build_failure(const std::string& device, const std::string& kernel, const std::string& options,
                          const std::string& log);

}  // namespace gloam
