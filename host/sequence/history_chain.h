// What each frame of a sequence leaves for the next, of techniques that accumulate over time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

class HistoryChain {
 public:
  /// Whether a frame has left something.
  bool holds_any() const { return before_.has_value(); }
  /// What follows begins a sequence.
  void begin_anew() { before_.reset(); }

  /// Adds to a frame those of `inputs` that come from the frame before; they know nothing where a sequence begins. Returns whether
  /// the frame goes on from another.
  bool take_over(Frame& frame, const std::vector<std::string>& inputs);

  /// Keeps of a frame's result what the next one takes over, and removes from the result the planes that are not in `written`.
  /// `name`: of the frame, for messages.
  void leave_for_next(const Frame& frame, Frame& result, const std::vector<std::string>& written,
                      const std::string& name);

 private:
  std::optional<Frame> before_;
  std::string name_;
};

/// Outputs to ask of a technique for, so that each frame leaves what the next one takes over, too.
std::vector<std::string> with_planes_for_history(std::vector<std::string> outputs, const std::string& technique);

/// Whether a frame's motion leads to another frame than `before`, the number of the one that was computed before it: no history can be
/// taken over.
bool motion_leads_elsewhere(const std::vector<std::string>& inputs, int before, int number);

/// Other samples in each frame, the same whichever process computes it.
int seed_in_sequence(int seed, int frame_number);

}  // namespace gloam
