// Frames written as EXR files.
#pragma once

#include <string>

#include "base/files.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// `name`: of the file, for messages. Throws Error with the cause alone for a frame that no reader would understand, and for what
/// cannot be written.
void write_exr(NewFile& file, const std::string& name, const Frame& frame, const WriteOptions& options);

}  // namespace gloam
