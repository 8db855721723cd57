// Which frames of a sequence are computed, and from whose files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/words.h"
#include "gloam/frame_pattern.h"

namespace gloam {

/// What happens to a frame whose files are not there.
enum class MissingFrames { error, skip, hold };
/// Their words, for commands and the Python module.
inline const Choices<MissingFrames> missing_words = {
    {"error", MissingFrames::error}, {"skip", MissingFrames::skip}, {"hold", MissingFrames::hold}};

/// A frame of a sequence. `source`: the number of the files it is read from; another one for a frame that is held.
struct SequenceFrame {
  int number, source;
};

/// `frames` without a range: all that are there; with `missing`, also the numbers between the first and the last of them.
struct FrameChoice {
  std::optional<std::vector<int>> frames;
  std::optional<MissingFrames> missing;  ///< none: error
  bool may_hold = true;                  ///< whether messages may advise to hold frames
};

/// `files`: one pattern, or one for each eye; a frame is there if all its files are. Appends a sentence to `notes` for frames
/// that are left out or held. Throws Error, in one line, if no frame is there, and for frames that are missing.
std::vector<SequenceFrame> list_frames(const std::vector<FramePattern>& files, const FrameChoice& choice,
                                       std::vector<std::string>& notes);

}  // namespace gloam
