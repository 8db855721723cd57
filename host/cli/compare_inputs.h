// What the forms of `gloam compare` share: flags, which planes are worth comparing, what lies under what.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"

namespace gloam::cli {

/// Flags of both forms.
struct CompareFlags {
  std::string test, reference, picture, frame, plane;
  std::optional<double> exposure;
  FrameFlags frame_flags;
  JsonFlag json;

  /// A --plane that is a plane's name alone says what to compare, as --what does.
  void take_plane_names();
};

/// A plane of the test and the plane of the reference that it is measured against.
struct PlanePair {
  std::string test, reference;
};

/// What techniques make, by what it can be measured against, best first. AO is AO before a filter and after.
const std::vector<PlanePair>& result_pairs();

/// Those of a file's planes that techniques make.
std::vector<std::string> results_among(const std::vector<std::string>& planes);

/// Those of a file's planes that techniques do not make, the most telling first.
std::vector<std::string> inputs_among(const std::vector<std::string>& planes);

/// The planes that could be compared: the one asked for, else those that both files have, results before inputs.
std::vector<PlanePair> comparable_planes(const FrameFile& test, const FrameFile& reference, const std::string& asked);

/// The part of a plane, which covers `from`, that `to` covers; all of it where `to` is empty.
Plane cropped(const Plane& plane, const Window& from, const Window& to);

/// Whether a frame covers a window, or has its size where the window is empty.
bool covers(const Frame& frame, const Window& window, const Layout& layout);

/// The view of a --frame that goes with a view of the test: of the same name, or the only one.
std::string view_of(const Frame& frame, const std::string& name);

/// Options for a file beside the test: its channels are not those of the test, and one unnamed view leaves nothing to
/// choose.
ReadOptions options_beside(const ReadOptions& options, const std::string& path);

/// What of --frame lies under the images: their window where it shows the same display window, all of it (an empty
/// window) where it has their size. Throws Error for a frame of another size: which of its pixels are theirs is not
/// known.
Window window_under(const Frame& extra, const std::string& path, const Frame& test, const Window& window,
                    const Layout& layout);

}  // namespace gloam::cli
