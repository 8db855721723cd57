// A result laid over the frame's colour. What makes a whole picture of several results is in composition.h.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

struct Compositing {
  double strength = 1;                     ///< from 0, nothing; 1: as computed
  std::array<double, 3> tint = {0, 0, 0};  ///< of ambient occlusion: what is left of the colour where nothing is open
};

/// The first of these planes that can be laid over colour: "ao", "ao_raw" or "reflection"; empty if none can.
std::string composited_plane(const std::vector<std::string>& planes);

/// Changes the plane `color` of all views, in scene-linear values, by a plane of `result`:
/// - AO: colour x max(0, 1 - strength (1 - AO) (1 - tint)), so that strength 1 gives colour x AO, and colour x tint where AO is 0; of a
///   colour with emission, backdrop, volume or transmission beside it what is left without them, and with illumination and albedo their
///   product;
/// - reflection: colour + strength x reflection, its R, G and B as they are, since these are radiance towards the eye already.
/// Where that changes nothing (background), colour keeps its bits. Throws Error for views or sizes that differ.
void composite(Frame& colour, const Frame& result, const std::string& plane, const Compositing& how);

}  // namespace gloam
