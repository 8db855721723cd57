// What the forms of `gloam compare` share: flags and outputs.
#pragma once

#include <optional>
#include <string>

#include "cli/flags/options.h"
#include "comparison/shot_files.h"

namespace gloam::cli {

/// Flags of all forms.
struct CompareFlags : comparison::ComparedFiles {
  std::string picture;
  FrameFlags frame_flags;
  JsonFlag json;

  /// Treats a --plane that is a plane's name alone as --what: the plane to compare.
  void take_plane_names();
};

/// The shot of a comparison. Throws UsageError if an output is an input or another output, and Error if one cannot be written. `differences`: of the
/// flag of that name; empty for none.
comparison::ComparedShot open_shot(const CompareFlags& flags, const FrameChoice& choice,
                                   const std::string& differences);

}  // namespace gloam::cli
