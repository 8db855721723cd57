// How a file is read beside another one.
#pragma once

#include <string>

#include "gloam/exr.h"

namespace gloam {

/// Options for a file other than the first: without choices of channels, which are the first's, and without a choice of views if the
/// file has one unnamed view.
ReadOptions options_beside(const ReadOptions& options, const std::string& path);

}  // namespace gloam
