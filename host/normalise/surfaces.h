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

/// `normals`: null for a view without them. Normals that nothing is stated of are in view space, unless they agree with the depth in another
/// convention alone. Throws Error for normals that are stated to be in world space, with a camera without a pose.
StoredSurfaces look_at_surfaces(const DepthRows& depth, const NormalSamples* normals, const Window& window,
                                const Camera& camera, const NormalConvention& stated);

/// Brings planes that have just been put into a frame to gloam's conventions, in place. Adds to `Frame::assumed`. `has_new_normals`: else
/// those of the frame are in gloam's convention already, and are compared with its new depth.
void settle_surfaces(Frame& frame, bool has_new_normals, const NormalConvention& stated);

/// What there is to say of a view that is in gloam's conventions by the word of whoever made it.
std::vector<std::string> notes_on_agreement(const View& view, const Window& window);

}  // namespace gloam
