// The two sides of `gloam compare`: which planes and views belong together, and where the background is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/compare/rows.h"
#include "gloam/error.h"

namespace gloam::cli {

/// Surveys both sides and returns the planes to compare: the first that are usable in both. `is_told`: --frame tells the
/// background.
PlanePair survey_sides(Side& test, Side& reference, const std::string& asked, bool is_told);

/// Names of a view of the test and of the view of the reference that it is compared with.
using ViewPairs = std::vector<std::pair<std::string, std::string>>;

/// Pairs of views (test, reference): the only two there are; the one that a file of one view is named after; those of
/// the same name. A file's name wins over its view's: a file that lists both eyes and holds one is read as the first. `is_told`: by
/// --view.
ViewPairs pair_views(const FrameFile& test, const FrameFile& reference, bool is_told);

/// The exposure by the flag, else by the reference.
double exposure_of(const CompareFlags& flags, const FrameFile& reference, const std::string& plane);

/// Adds a note if a view's poses in the two headers differ: most likely two frames are compared.
void note_other_camera(const FrameFile& test, const FrameFile& reference);

/// Adds a note for an AO made with another radius than its truth.
void note_other_radius(const FrameFile& test, const FrameFile& reference);

/// The depth of --frame; an empty frame without that flag.
Frame background_frame(const CompareFlags& flags, const ReadOptions& options);

/// The foreground by --frame, since the user named it; else by the files' own depth.
std::optional<Mask> mask_of(const CompareFlags& flags, const Frame& extra, const Side& test, const Side& reference,
                            const std::pair<std::string, std::string>& views, const Overlap& overlap, const Rows& rows);

/// Adds the files' names to an error about inputs that cannot be compared.
template <typename Work>
auto naming_files(const CompareFlags& flags, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error("{} against {}: {}", flags.test, flags.reference, error.what());
  }
}

}  // namespace gloam::cli
