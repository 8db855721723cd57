// gloam compare --stereo 'TEST.####.exr': how far the two views of each frame are from each other.
#pragma once

#include "cli/compare/sequence.h"
#include "cli/compare/stereo.h"

namespace gloam::cli {

void compare_stereo_sequence(const CompareFlags& flags, const StereoFlags& stereo,
                             const CompareSequenceFlags& sequence);

}  // namespace gloam::cli
