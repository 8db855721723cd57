// Frames in closed form whose ambient occlusion is known in closed form too: the hard cases of a set.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam::sets {

/// Depth and normals, and the truth `ao` in a frame of its own: for binary visibility within the radius, cosine-weighted.
struct HardFrame {
  Frame frame, truth;
};

/// In the order in which they are listed.
const std::vector<std::string>& hard_frame_names();

/// One sentence: what is hard.
std::string help_of_hard_frame(const std::string& name);

/// Throws std::out_of_range for an unknown name.
HardFrame hard_frame(const std::string& name, int width, int height, double radius);

/// Share of the light of a hemisphere that a wall leaves, which stands up at a right angle at this distance from a point of a floor,
/// if only what is within the radius counts; `height`: of the wall, may be infinite.
double ao_beside_wall(double distance, double height, double radius);

}  // namespace gloam::sets
