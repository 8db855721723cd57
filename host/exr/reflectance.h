// Reflectance that a renderer may have written as 1 whatever the surface reflects.
#pragma once

#include "exr/file.h"
#include "gloam/frame.h"

namespace gloam {

/// Cycles' GlossCol is 1 where a Principled BSDF is no metal. Not where the user chose the channel.
bool may_be_white_by_default(const ExrFile& file, const View& view);

/// Notes it where the reflectance is 1 on half of the surfaces or more. `share`: of surfaces where it is 1.
void note_white_reflectance(double share, Frame& frame);

/// Counts the white pixels of a view whose reflectance may be white by default, and notes them.
void check_reflectance(const ExrFile& file, const View& view, Frame& frame);

}  // namespace gloam
