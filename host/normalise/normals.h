// Brings stored normals to view space.
#pragma once

#include <string>

#include "gloam/camera.h"
#include "gloam/frame.h"
#include "normalise/normal_form.h"

namespace gloam {

/// Brings stored normals to view space, in place. Those that an encoded plane has for none become zero.
void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera);
/// The same for a row.
void bring_to_view_space(float* x, float* y, float* z, int width, const NormalForm& form, const Camera& camera);

/// Number of foreground pixels whose normal is zero or not finite. `depth`: after `to_view_depth`, the whole image; `normal`: its
/// rows from `first_row` on.
long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row = 0);

/// A sentence on them; empty for 0.
std::string note_on_missing_normals(long long missing);

}  // namespace gloam
