// Frames written as EXR files.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <string>

#include "base/files.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// `name`: the file's name, for messages. Throws Error, with the cause alone, for a frame that no reader would understand and if
/// writing fails. `like`: a header whose attributes the file gets too, unless it has them itself or they tell how pixels are stored.
void write_exr(NewFile& file, const std::string& name, const Frame& frame, const WriteOptions& options,
               const Imf::Header* like = nullptr);

}  // namespace gloam
