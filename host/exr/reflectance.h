// Reflectance that a renderer may have written as 1 for any surface.
#pragma once

#include "exr/file.h"
#include "gloam/frame.h"

namespace gloam {

/// Whether the reflectance is Cycles' GlossCol, which is 1 for any Principled BSDF that is not metallic. False if the user chose
/// the channel.
bool may_be_white_by_default(const ExrFile& file, const View& view);

/// Adds a note if `share`, the share of surfaces with a reflectance of 1, is half or more.
void note_white_reflectance(double share, Frame& frame);

/// Counts the white pixels of a view whose reflectance may be white by default, and notes them.
void check_reflectance(const ExrFile& file, const View& view, Frame& frame);

}  // namespace gloam
