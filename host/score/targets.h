// What gloam score and gloam bench --set measure on: the items of a set, or the user's own frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "score/result_file.h"
#include "score/target.h"
#include "set/manifest.h"

namespace gloam::score {

struct ScoredSet {
  report::SetFacts id;
  std::vector<Target> targets;  ///< one for each item and each of its effects
};

/// Throws Error for a folder that holds no set. Appends to `notes` what is assumed. Files are checked against the manifest's hashes when they are used.
ScoredSet read_set(const std::string& folder, std::vector<std::string>& notes);

/// Throws UsageError for a name that no item has.
void keep_items(std::vector<Target>& targets, const std::vector<std::string>& names);

/// Frames and truths of the user's own; patterns for a sequence.
struct OwnFrames {
  std::string frame;
  std::vector<std::string> truths;
  ReadOptions reading;
};

/// One target for each effect that the truths hold, and one for `effect`. Throws UsageError where frame and truths do not go together, and Error
/// for files that cannot be opened.
std::vector<Target> own_targets(const OwnFrames& own, const std::string& effect);

/// The files of a target's frames where their names are free: one image, one for each view, or a pattern of a sequence. None for folders,
/// whose files are found by their names.
std::optional<std::vector<SubmittedFile>> files_given(const std::vector<std::string>& images, const Target& target,
                                                      int frame);

}  // namespace gloam::score
