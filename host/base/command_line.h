// The command as it was given.
#pragma once

#include <string>
#include <vector>

namespace gloam {

/// The program's name without its folder, and its arguments; of absolute paths the last folder and the name, since files that hold a
/// command are passed on. Empty where the system does not tell.
std::vector<std::string> command_line();

}  // namespace gloam
