// The input of `gloam compare`: the planes of two files over the same pixels, some rows at a time.
#pragma once

#include <optional>
#include <string>

#include "cli/compare/inputs.h"
#include "gloam/exr.h"
#include "gloam/metrics.h"

namespace gloam::cli {

/// The pixels that both images cover.
struct Overlap {
  Window window;  ///< of both images; empty: each has its own window, of the same size
  Layout layout;
};

/// Rows [first, last) of an overlap.
struct Rows {
  int first = 0, last = 0;
};

/// A file with the plane to compare; values as in the file.
struct Side {
  FrameFile file;
  Frame frame;  ///< the depth, which tells the background

  /// Surveys the plane and, if `with_depth`, the depth if the file has one.
  void survey(const std::string& plane, bool with_depth);
  /// Whether the surveyed plane is usable in all views.
  bool has(const std::string& plane);
  /// Decodes rows of the plane, of all views.
  Frame read(const std::string& plane, const Overlap& overlap, const Rows& rows);
  /// The plane of one view from the result of `read`.
  Plane rows_of(const Frame& read, const std::string& plane, const std::string& view, const Overlap& overlap,
                const Rows& rows) const;
};

/// The pixels of both frames: their windows, or the display window if it is the same and the windows differ. Throws Error for
/// images of different size.
Overlap overlap_of(const Side& test, const Side& reference);

/// Foreground of a view of one frame; none if the frame has no depth for that view.
std::optional<Mask> foreground(const Frame& frame, const std::string& name, const Overlap& overlap, const Rows& rows);

/// Peak memory of a comparison, bytes.
unsigned long long bytes_of_comparison(const CompareFlags& flags, const ReadOptions& options, const FrameFile& test,
                                       const FrameFile& reference);

}  // namespace gloam::cli
