// What nothing states of a depth, as its plane surfaces tell it.
#pragma once

#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/stored_depth.h"

namespace gloam {

/// What to read a depth by of which `stated` states no convention: planar distance, unless plane surfaces are plane by something else.
/// `depth`: as stored; `found`: what look_at_depth found of it. In a shot, whose frames are read alike, it stays planar distance.
/// `assumed` gets one sentence: what was taken, why, and which flags say otherwise; or what is told and cannot be taken, with what it
/// needs. The convention of the result is not `automatic`.
StatedDepth told_by_planes(const Channel& depth, const StoredDepth& found, const Window& window, const Camera& camera,
                           const StatedDepth& stated, std::vector<std::string>& assumed);

}  // namespace gloam
