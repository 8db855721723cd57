// Options in messages, spelled as the caller writes them.
#pragma once

#include <string>
#include <string_view>

namespace gloam {

/// Who reads the messages: the user of the command, of the Python module, or of a C++ program that links the libraries.
enum class Caller { command, python, program };

/// Says who calls; a C++ program is assumed. Call it once, before other threads run.
void set_caller(Caller caller);

/// An option by the name of its flag: "--fov" for the command, "fov=" in Python, "ReadOptions::fov_degrees" in C++. `value`, if any, is
/// what it was or should be set to; capitals such as FILE stand for one. "--real float", "real='float'", "RunOptions::real = float".
std::string option(std::string_view name, std::string_view value = {});

/// The option that says which channels of a file hold a plane: "--plane depth=Layer.Z", "channels={'depth': 'Layer.Z'}".
std::string channels_option(std::string_view plane, std::string_view channels);

}  // namespace gloam
