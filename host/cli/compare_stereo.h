// gloam compare --stereo OUT.exr: differences between the two views of a result.
#pragma once

#include <string>

#include "cli/compare_inputs.h"

namespace gloam::cli {

struct StereoFlags {
  bool is_asked_for = false, no_normal_check = false;
  double normal_check = 6, magnify = 20;
  std::string anaglyph, side_by_side;
  void add_to(CLI::App& app);
};

void stereo_command(const CompareFlags& flags, const StereoFlags& stereo);

}  // namespace gloam::cli
