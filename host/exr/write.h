// Frames written as EXR files.
#pragma once

#include <string>

#include "base/files.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// `name`: the file's name, for messages. Throws Error, with the cause alone, for a frame that no reader would understand and if
/// writing fails.
void write_exr(NewFile& file, const std::string& name, const Frame& frame, const WriteOptions& options);

}  // namespace gloam
