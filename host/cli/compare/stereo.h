// gloam compare --stereo OUT.exr: differences between the two views of a result.
#pragma once

#include <string>

#include "cli/compare/inputs.h"
#include "gloam/stereo_consistency.h"

namespace gloam::cli {

struct StereoFlags {
  bool is_asked_for = false, no_normal_check = false;
  double normal_check = 6, magnify = 20;
  std::string anaglyph, side_by_side;
  void add_to(CLI::App& app);
};

/// Two views of a frame, and how far they are from each other.
struct StereoComparison {
  Frame pair;
  std::string plane;
  StereoInconsistency result;
  unsigned long long memory = 0;  ///< planned, bytes
};

StereoComparison compare_stereo(const CompareFlags& flags, const StereoFlags& stereo, const ReadOptions& options);
Json stereo_document(const StereoComparison& comparison);

void stereo_command(const CompareFlags& flags, const StereoFlags& stereo);

}  // namespace gloam::cli
