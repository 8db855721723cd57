// What a shot reads, for the ledger of files (base/file_ledger.h): all that its pattern names, not only the frames asked for.
#pragma once

#include "gloam/frame_pattern.h"

namespace gloam {

/// Tells the ledger of the files of all frames that are there, and of the names of those that may come: "frame 4 of shot.####.exr".
void reads_pattern(const FramePattern& pattern);

/// Tells the ledger of the camera JSON files that the search beside a pattern's frames finds.
void reads_cameras_beside(const FramePattern& pattern);

}  // namespace gloam
