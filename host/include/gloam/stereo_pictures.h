// Pictures of a result with two views: where they disagree, and both for two eyes.
#pragma once

#include <filesystem>

#include "gloam/frame.h"
#include "gloam/stereo_consistency.h"

namespace gloam {

/// The errors of one view as grey, black for none and white for 1 / `magnify` and more; pixels that do not count purple
/// over `shown`, the plane compared (Shi, Billeter, Eisemann 2022, figure 9); background hatched. Under the image,
/// which keeps its pixels, a legend on white; at least 320 pixels wide. PNG, written atomically.
void write_inconsistency_picture(const std::filesystem::path& path, const Plane& shown, const StereoErrors& errors,
                                 double magnify);

/// For glasses that are red on the left and cyan on the right: red of the left plane, green and blue of the right one.
/// Colours as `write_picture` has them. PNG, written atomically. Throws Error for planes of different size.
void write_anaglyph(const std::filesystem::path& path, const Plane& left, const Plane& right);

/// The left plane on the left and the right one on the right, without a gap, as viewers of stereo pictures expect. PNG
/// of twice the width, written atomically. Throws Error for planes of different size.
void write_side_by_side(const std::filesystem::path& path, const Plane& left, const Plane& right);

}  // namespace gloam
