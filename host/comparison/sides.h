// The two sides of a comparison: planes over the same pixels, some rows at a time, which planes and views belong together, and where
// the background is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "comparison/files.h"
#include "gloam/error.h"
#include "gloam/metrics.h"

namespace gloam::comparison {

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

/// Peak memory of a comparison, bytes. `draws`: a picture needs all rows at once.
unsigned long long bytes_of_comparison(const ComparedFiles& files, const ReadOptions& options, const FrameFile& test,
                                       const FrameFile& reference, bool draws);

/// Surveys both sides and returns the planes to compare: the first that are usable in both. `is_told`: another frame
/// tells the background.
PlanePair survey_sides(Side& test, Side& reference, const std::string& asked, bool is_told);

/// Names of a view of the test and of the view of the reference that it is compared with.
using ViewPairs = std::vector<std::pair<std::string, std::string>>;

/// Pairs of views (test, reference): the only two there are; the one that a file of one view is named after; those of
/// the same name. A file's name wins over its view's: a file that lists both eyes and holds one is read as the first. `is_told`: the
/// options choose views. Appends to `notes` what is assumed.
ViewPairs pair_views(const FrameFile& test, const FrameFile& reference, bool is_told, std::vector<std::string>& notes);

/// The exposure asked for, else the reference's.
double exposure_of(const ComparedFiles& files, const FrameFile& reference, const std::string& plane);

/// Appends a note if a view's poses in the two headers differ, since most likely two frames are compared, and for an AO made with
/// another radius than its truth.
void note_differences(const FrameFile& test, const FrameFile& reference, const PlanePair& planes,
                      std::vector<std::string>& notes);

/// The frame that the test was made of, where neither file has depth, the test names the frame and the frame has the depth of all its views; else
/// empty. Adds a note.
std::string frame_of_result(const FrameFile& test, const FrameFile& reference, const ReadOptions& options,
                            std::vector<std::string>& notes);

/// The frame that is named beside the two, and whose depth tells the background. Throws Error for one without depth.
FrameFile background_file(const ComparedFiles& files, const ReadOptions& options);

/// The foreground by the frame, where one is named; else by the files' own depth.
std::optional<Mask> mask_of(const ComparedFiles& files, const Frame& extra, const Side& test, const Side& reference,
                            const std::pair<std::string, std::string>& views, const Overlap& overlap, const Rows& rows);

/// Adds the files' names to an error about inputs that cannot be compared.
template <typename Work>
auto naming(const ComparedFiles& files, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error("{} against {}: {}", files.test, files.reference, error.what());
  }
}

}  // namespace gloam::comparison
