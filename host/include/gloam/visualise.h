// Pictures for people, drawn with OpenCV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam {

/// The picture of `gloam compare`: test, truth, signed difference in a diverging colour map with a scale bar, and the
/// histogram of the differences, titled, with the figures written under it. PNG, written atomically.
struct DifferencePicture {
  std::string test_name, truth_name;  ///< file names for the titles
  float range = 0;  ///< difference at the ends of the colour map; 0: the smallest of 0.05, 0.1, 0.2, 0.5, 1 that covers
                    ///< 99 % of the pixels
  double exposure = 0;  ///< of radiance: test and truth are shown multiplied by it; 0: as they are
};
void write_difference_picture(const std::filesystem::path& path, const Plane& test, const Plane& truth,
                              const Mask& foreground, const Metrics& metrics, const DifferencePicture& options);

/// What `gloam auto` has found out of one effect.
struct Explanation {
  std::string title, why, cost;  ///< lines of text
  const Plane* where = nullptr;  ///< above 0 where it is called for: one pixel for each pixel or square tile
  bool is_everywhere = false;
};

/// A view's colours, or its surfaces lit from the eye where it has none, tinted where effects are called for, and under
/// it the lines of each. PNG, written atomically.
void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations);

/// One plane as an 8-bit PNG: grey for one component (0..1), normals as 0.5 + 0.5 n, others clamped to 0..1 through
/// sRGB. `depth`, where given, tells where no surface is: hatched there, as nothing that is open is.
void write_picture(const std::filesystem::path& path, const Plane& plane, const Plane* depth = nullptr);

/// All planes of a frame as small pictures on one sheet, each under its name and the range of its values.
struct ContactSheet {
  std::string title;     ///< the file's or the scene's name
  int tile_width = 480;  ///< pixels, 64 to 4096; larger images are reduced, smaller ones enlarged by a whole factor
  int columns = 0;       ///< 0: as many as rows, up to 4
  int layers = 4;        ///< layers drawn of each stack (peel), the rest is counted ("and 4 more"); 0: all
  int colour_step = 1;   ///< colours are rounded to multiples: 4 is hardly seen and makes files 20 to 30 % smaller
};

/// One tile per plane and view; each view starts a row. Colours by meaning: depths on one logarithmic scale for the
/// whole sheet, which stands in the header; normals as 0.5 + 0.5 n; colours through sRGB; instances as colours of their
/// own; motion as hue by direction and brightness by length; what is none of these grey over its range, without the
/// outermost 1 % of the values where these would take half of it. Pixels without a surface are hatched (the sky of
/// `color` and `alpha` is drawn); foreground values that are not finite are magenta, and counted.
/// PNG, written atomically. Throws Error for a frame without planes or pixels, for planes of another size than the
/// frame's, and for a tile width that is not allowed.
void write_contact_sheet(const std::filesystem::path& path, const Frame& frame, const ContactSheet& options);

/// One plane of every view, for frames of many.
struct ViewSheet {
  std::string title;  ///< the file's or the scene's name
  std::string plane;
};

/// One tile per view under its name, in rows, on a sheet of at most 2400 pixels' width (higher where there are very many
/// views). Colours as on the contact sheet, on one scale for all views.
/// PNG, written atomically. Throws Error where a view lacks the plane or has it in another size or form.
void write_view_sheet(const std::filesystem::path& path, const Frame& frame, const ViewSheet& options);

/// One row of pixels of every view.
struct ScanLines {
  std::string title;  ///< the file's or the scene's name
  std::string plane;
  int row = 0;  ///< of the display window, 0 on top
};

/// The same row of each view, one below the other in the order of the views and each as thick as makes 320 pixels of them
/// all. Where the cameras stand side by side on a line and share their rows, that is an epipolar-plane image: a point of
/// a surface is a straight line, and the nearer it is the more it slants. Colours as on the contact sheet, on one scale.
/// PNG, written atomically. Throws Error as `write_view_sheet` does, and for a row outside the display window.
void write_scan_lines(const std::filesystem::path& path, const Frame& frame, const ScanLines& options);

}  // namespace gloam
