// All planes of a frame on one sheet.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"

namespace gloam {

/// All planes of a frame as small pictures on one sheet, each under its name and the range of its values.
struct ContactSheet {
  std::string title;     ///< the file's or the scene's name
  int tile_width = 480;  ///< pixels, 64 to 4096; larger images are reduced, smaller ones enlarged by a whole factor
  int columns = 0;       ///< 0: as many as rows, up to 4
  int layers = 4;        ///< most layers drawn of each stack (peel); the rest is counted ("and 4 more"); 0: all
  int colour_step = 1;  ///< colours are rounded to multiples of this: 4 is hardly visible, files get 20 to 30 % smaller
};

/// One tile per plane and view; each view starts a row. Colours by meaning: depths on one logarithmic scale for the whole sheet,
/// drawn in the header; normals as 0.5 + 0.5 n; colours through sRGB; instances in a colour each; motion as hue by direction and
/// brightness by length; other planes grey over their range, without the outermost 1 % of the values where these would take half
/// of the range. Pixels without a surface are hatched (but the sky of `color` and `alpha` is drawn); foreground values that are
/// not finite are magenta, and counted. PNG, written atomically. Throws Error for a frame without planes or pixels, for planes
/// whose size is not the frame's, and for a tile width out of range.
void write_contact_sheet(const std::filesystem::path& path, const Frame& frame, const ContactSheet& options);

}  // namespace gloam
