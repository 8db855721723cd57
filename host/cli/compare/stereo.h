// gloam compare --stereo OUT.exr: differences between the two views of a result.
#pragma once

#include <string>
#include <vector>

#include "cli/compare/inputs.h"
#include "cli/compare/sequence.h"
#include "comparison/eyes.h"

namespace gloam::cli {

struct StereoFlags {
  bool is_asked_for = false, no_normal_check = false;
  double normal_check = 6, magnify = 20;
  std::string anaglyph, side_by_side;
  void add_to(CLI::App& app);
  StereoOptions options() const;
};

struct StereoComparison : comparison::EyeFigures {
  unsigned long long memory = 0;  ///< planned, bytes
};

/// Throws UsageError for --view: two views are compared.
void check_no_single_view(const CompareFlags& flags);

/// Throws Error for more memory than the flags allow.
StereoComparison compare_stereo(const comparison::ComparedFiles& files, const ReadOptions& options,
                                const FrameFlags& flags, const StereoFlags& stereo);
Json stereo_document(const StereoComparison& comparison);

/// A table's heading, and the row of a view or of a frame.
std::vector<std::string> stereo_heading(const std::string& first);
std::vector<std::string> stereo_cells(const std::string& name, const StereoFigures& figures);

void stereo_command(const CompareFlags& flags, const StereoFlags& stereo);

void compare_stereo_sequence(const CompareFlags& flags, const StereoFlags& stereo,
                             const CompareSequenceFlags& sequence);

}  // namespace gloam::cli
