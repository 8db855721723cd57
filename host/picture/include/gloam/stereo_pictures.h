// Pictures of a result with two views: where they disagree, and stereo pictures.
#pragma once

#include <filesystem>

#include "gloam/frame.h"
#include "gloam/stereo_consistency.h"

namespace gloam {

/// The errors of one view as grey: black for none, white for 1 / `magnify` or more. Pixels that do not count are purple over
/// `shown`, the plane compared (Shi, Billeter, Eisemann 2022, figure 9); background is hatched. A legend on white stands under
/// the image, at least 320 pixels wide. PNG, written atomically.
void write_inconsistency_picture(const std::filesystem::path& path, const Plane& shown, const StereoErrors& errors,
                                 double magnify);

/// An anaglyph for red-cyan glasses: red from the left plane, green and blue from the right one. Colours as in `write_picture`.
/// PNG, written atomically. Throws Error for planes of different size.
void write_anaglyph(const std::filesystem::path& path, const Plane& left, const Plane& right);

/// The left plane beside the right one, without a gap, as stereo viewers expect. PNG of twice the width, written atomically. Throws
/// Error for planes of different size.
void write_side_by_side(const std::filesystem::path& path, const Plane& left, const Plane& right);

}  // namespace gloam
