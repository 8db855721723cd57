// Depth and normals in memory, whose conventions nothing but their values may tell.
#pragma once

#include <string>
#include <vector>

#include "normalise/normal_form.h"
#include "normalise/stored_depth.h"

namespace gloam {

/// How the surfaces of a view are stored.
struct StoredSurfaces {
  StoredDepth depth;
  NormalForm normals;
  bool are_normals_used = true;    ///< false: they fit no convention, and nobody says that they do
  std::vector<std::string> notes;  ///< a sentence for each assumption
};

/// What is stated of the depth and the normals of arrays.
struct StatedSurfaces {
  NormalConvention normals;
  StatedDepth depth;
};

/// `depth`: along the viewing axis. `normals`: null for a view without them. Normals that nothing is stated of are in view space, unless they agree with the depth in another
/// convention alone. Throws Error for normals that are stated to be in world space, with a camera without a pose.
StoredSurfaces look_at_surfaces(const DepthRows& depth, const NormalSamples* normals, const Window& window,
                                const Camera& camera, const StatedSurfaces& stated);

/// Planes of a frame that have just been put into it; its others are in gloam's conventions already.
struct NewSurfaces {
  bool depth = false, normals = false;
};

/// Brings new planes to gloam's conventions, in place, and compares depth and normals with each other. Adds to `Frame::assumed`.
void settle_surfaces(Frame& frame, const NewSurfaces& given, const StatedSurfaces& stated);

/// What there is to say of a view that is in gloam's conventions by the word of whoever made it.
std::vector<std::string> notes_on_agreement(const View& view, const Window& window);

}  // namespace gloam
