// What nothing states of a depth, as the normals beside it tell it: its meaning, and what was done to it before it was stored.
#pragma once

#include <optional>
#include <utility>

#include "gloam/camera.h"
#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/depth_by_normals.h"
#include "normalise/stored_depth.h"

namespace gloam {

/// A depth by whose meaning it agrees with the normals, and how it is encoded.
struct ToldByNormals {
  MeaningByNormals meaning;
  DepthEncoding encoding;
  /// Another encoding that may be meant as well, and by how much the normals then miss.
  std::optional<std::pair<DepthEncoding, double>> as_good_as = {};
};

/// As stored, or else, where that may be, with an encoding undone that makes depth and normals agree much better. None where the normals tell
/// nothing.
std::optional<ToldByNormals> told_by_normals(const Channel& depth, const StoredDepth& found, const Window& window,
                                             const Camera& camera, const NormalsBeside& normals, bool may_be_encoded);

}  // namespace gloam
