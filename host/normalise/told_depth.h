// What nothing states of a depth, as the normals beside it or its plane surfaces tell it.
#pragma once

#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/depth_by_normals.h"
#include "normalise/stored_depth.h"

namespace gloam {

/// How to read a depth, and whether anything told it.
struct ToldDepth {
  StatedDepth read;
  bool is_told = true;
};

/// What to read a depth by of which `stated` states no convention: what makes depth and normals agree; without normals, or where they tell
/// nothing, planar distance, unless plane surfaces are plane by something else. `depth`: as stored; `found`: what look_at_depth found of it.
/// In a shot, whose frames are read alike, it stays planar distance where `stated.is_of_shot`. `assumed` gets one sentence: what was taken, why, and which flags say
/// otherwise; or what is told and cannot be taken, with what it needs. The convention of the result is not `automatic`.
ToldDepth told_by_surfaces(const Channel& depth, const StoredDepth& found, const Window& window, const Camera& camera,
                           const StatedDepth& stated, const NormalsBeside* normals, std::vector<std::string>& assumed);

/// A sentence on a depth that is taken as planar distance, as arrays are asked for, where the normals beside it say that it is something else;
/// empty if they do not.
std::string note_on_contradicted_planar(const DepthRows& depth, const StoredDepth& found, const Window& window,
                                        const Camera& camera, const NormalsBeside& normals);

}  // namespace gloam
