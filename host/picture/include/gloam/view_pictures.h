// Many views in one picture: one plane of each view, or one row of pixels of each.
#pragma once

#include <filesystem>
#include <string>

#include "gloam/frame.h"

namespace gloam {

/// One plane of every view, for frames with many views.
struct ViewSheet {
  std::string title;  ///< the file's or the scene's name
  std::string plane;
};

/// One tile per view with its name, in rows, on a sheet at most 2400 pixels wide (higher if there are very many views). Colours
/// as on the contact sheet, on one scale for all views. PNG, written atomically. Throws Error if a view lacks the plane or has it
/// in another size or form.
void write_view_sheet(const std::filesystem::path& path, const Frame& frame, const ViewSheet& options);

/// One row of pixels of every view.
struct ScanLines {
  std::string title;  ///< the file's or the scene's name
  std::string plane;
  int row = 0;  ///< row of the display window, 0 on top
};

/// The same row of each view, one below the other in the order of the views, thick enough for 320 pixels in all. If the cameras
/// stand side by side on a line and share their rows, this is an epipolar-plane image: a point of a surface is a straight line,
/// and the nearer it is the more it slants. Colours as on the contact sheet, on one scale. PNG, written atomically. Throws Error
/// as `write_view_sheet` does, and for a row outside the display window.
void write_scan_lines(const std::filesystem::path& path, const Frame& frame, const ScanLines& options);

}  // namespace gloam
