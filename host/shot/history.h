// What the frames of a shot take over from the one before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sequence/history_chain.h"
#include "shot/shot_run.h"

namespace gloam {

/// Adds the frames that a frame goes on from, in a word. `before`: the word of the frame before; empty where a history begins. Returns the
/// frame's own.
std::string add_history_to(FrameMaking& making, const std::string& before);

class ShotHistory {
 public:
  /// Begins anew where a frame does not follow the one computed last, and adds to `making` what it goes on from. Returns whether it begins
  /// anew since its motion leads to a frame that is not computed. `planes`: that the frame is computed from.
  bool follow(const FrameTurn& turn, const std::vector<std::string>& planes, FrameMaking& making);
  /// A frame that followed has been computed, and has left what the next takes over.
  void has_left(const FrameTurn& turn) { last_ = turn.index; }

  HistoryChain chain;

 private:
  std::optional<size_t> last_;
  std::string files_;  ///< a word for the files of the frames computed since a history began
};

}  // namespace gloam
