// Shared by the forms of `gloam compare`: flags, the choice of planes, and the alignment of images.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "compare/plane_pairs.h"

namespace gloam::cli {

/// Flags of both forms.
struct CompareFlags {
  std::string test, reference, picture, frame, plane;
  std::optional<double> exposure;
  FrameFlags frame_flags;
  JsonFlag json;

  /// Treats a --plane that is a plane's name alone as --what: the plane to compare.
  void take_plane_names();
};

/// The planes that could be compared: the one asked for, else those that both files have, results before inputs.
std::vector<PlanePair> comparable_planes(const FrameFile& test, const FrameFile& reference, const std::string& asked);

/// The part of a plane inside `to`; all of it if `to` is empty. `from`: the window of the plane.
Plane cropped(const Plane& plane, const Window& from, const Window& to);

/// Whether a frame covers a window; if the window is empty, whether the frame has the size of `layout`.
bool covers(const Frame& frame, const Window& window, const Layout& layout);

/// The view of --frame for a view of the test: that of the same name, or the only one.
std::string view_of(const Frame& frame, const std::string& name);

/// Options for a file other than the test: without choices of channels, which are the test's, and without a choice of views if the
/// file has one unnamed view.
ReadOptions options_beside(const ReadOptions& options, const std::string& path);

/// The part of --frame under the images: their window if the frame shows the same display window, all of it (an empty window) if
/// it has their size. Throws Error for a frame of another size, which cannot be aligned with the images.
Window window_under(const Frame& extra, const std::string& path, const Frame& test, const Window& window,
                    const Layout& layout);

}  // namespace gloam::cli
