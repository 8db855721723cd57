// The kernel files below kernels/, embedded at build time.
#pragma once

#include <map>
#include <string>

#include "gloam/parameters.h"

namespace gloam {

/// Path below kernels/ -> text.
const std::map<std::string, std::string>& kernel_sources();

/// A kernel file with its includes of other kernel files inserted, each once, and #line directives so that build logs name file
/// and line. Throws Error for a missing file.
std::string flatten(const std::string& file);

/// A technique's parameters as the struct Params, in OpenCL C; empty where there are none.
std::string struct_of(const ParameterList& parameters);

/// A flattened text without all other kernels, whose arguments differ. A kernel begins with a line `kernel void NAME(ARGUMENTS) {` and ends with
/// the line `}`.
std::string with_one_kernel(const std::string& source, const std::string& kernel);

/// The whole text of one kernel of a file, as it is compiled. `declaration`: of its parameters and arguments (run/arguments.h).
std::string kernel_text(const std::string& file, const std::string& kernel, const std::string& declaration);

}  // namespace gloam
