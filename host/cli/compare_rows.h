// What `gloam compare` reads: the planes of two files over the same pixels, some rows at a time.
#pragma once

#include <optional>
#include <string>

#include "cli/compare_inputs.h"
#include "gloam/exr.h"
#include "gloam/metrics.h"

namespace gloam::cli {

/// The pixels that both images cover.
struct Overlap {
  Window window;  ///< of both; empty: each its own, of one size
  Layout layout;
};

/// Rows [first, last) of these.
struct Rows {
  int first = 0, last = 0;
};

/// A file with the plane to compare; values as they stand in the file.
struct Side {
  FrameFile file;
  Frame frame;  ///< the depth, to know the background by

  /// `with_depth`: where there is one.
  void survey(const std::string& plane, bool with_depth);
  /// Whether the plane that was surveyed is of use in all views.
  bool has(const std::string& plane);
  /// Decodes rows of the plane, of all views.
  Frame read(const std::string& plane, const Overlap& overlap, const Rows& rows);
  /// Of one view what `read` came to.
  Plane rows_of(const Frame& read, const std::string& plane, const std::string& view, const Overlap& overlap,
                const Rows& rows) const;
};

/// Both frames over the same pixels: their windows, or the display window where they share one and the windows differ. Throws
/// Error for images of different size.
Overlap overlap_of(const Side& test, const Side& reference);

/// Foreground of a view of one frame; none where it has no depth for that view.
std::optional<Mask> foreground(const Frame& frame, const std::string& name, const Overlap& overlap, const Rows& rows);

/// How sure a reflection is, is no part of what it looks like, and in a truth it says something else.
Plane without_confidence(Plane plane);

/// Pixels of which the truth says that a view of the frame shows most of what they reflect; none where it does not say.
std::optional<Mask> shown_pixels(const Plane& truth, const Mask& mask);

/// Memory that a comparison takes at its peak.
unsigned long long bytes_of_comparison(const CompareFlags& flags, const ReadOptions& options, const FrameFile& test,
                                       const FrameFile& reference);

}  // namespace gloam::cli
