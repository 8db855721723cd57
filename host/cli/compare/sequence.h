// gloam compare 'TEST.####.exr' 'REF.####.exr': figures of each frame, and how the error changes from frame to frame.
#pragma once

#include <string>

#include "cli/compare/inputs.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

/// Flags that only a sequence has.
struct CompareSequenceFlags {
  FrameChoice choice{.frames = {}, .missing = {}, .may_hold = false};  ///< a frame that is held has no error of its own
  std::string differences;
  bool is_asked_for = false;
  void add_to(CLI::App& app);
  /// The first of these flags that was given; empty if there is none.
  std::string any() const;
};

/// Whether the test is a sequence. Throws UsageError for patterns and flags of a sequence beside a test that is one file.
bool is_sequence(const CompareFlags& flags, const CompareSequenceFlags& sequence);

/// Throws UsageError for a plot over frames that is no PNG, or a pattern.
void check_plot_name(const std::string& path);

void compare_sequence(const CompareFlags& flags, const CompareSequenceFlags& sequence);

}  // namespace gloam::cli
