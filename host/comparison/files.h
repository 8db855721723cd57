// What `gloam compare` compares: the files' names, the choice of planes, and the alignment of images.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/plane_pairs.h"
#include "gloam/exr.h"

namespace gloam::comparison {

/// A test, the reference that it is compared with, or the second eye's test, and the frame that both were made of. Empty: none.
struct ComparedFiles {
  std::string test, reference, frame;
  std::string plane;  ///< of the test; empty: the first that both have, results first
  std::optional<double>
      exposure;  ///< of radiance, before SSIM, GMSD and FLIP; none: what the truth of a reflection says
};

/// The planes that could be compared: the one asked for, else those that both files have, results before inputs.
std::vector<PlanePair> comparable_planes(const FrameFile& test, const FrameFile& reference, const std::string& asked);

/// The part of a plane inside `to`; all of it if `to` is empty. `from`: the window of the plane.
Plane cropped(const Plane& plane, const Window& from, const Window& to);

/// Whether a frame covers a window; if the window is empty, whether the frame has the size of `layout`.
bool covers(const Frame& frame, const Window& window, const Layout& layout);

/// The view of the frame for a view of the test: that of the same name, or the only one.
std::string view_of(const Frame& frame, const std::string& name);

/// The part of the frame under the images: their window if the frame shows the same display window, all of it (an empty window) if
/// it has their size. Throws Error for a frame of another size, which cannot be aligned with the images.
Window window_under(const Frame& extra, const std::string& path, const Frame& test, const Window& window,
                    const Layout& layout);

}  // namespace gloam::comparison
