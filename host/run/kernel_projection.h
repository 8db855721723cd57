// What kernels know of a view's projection (kernels/shared/frame/projection.h).
#pragma once

#include "gloam/frame.h"

namespace gloam {

#define PROJECTION_SCALAR float
#define PROJECTION_NAME ProjectionOfFloats
#include "shared/frame/projection.h"
#undef PROJECTION_SCALAR
#undef PROJECTION_NAME
#define PROJECTION_SCALAR double
#define PROJECTION_NAME ProjectionOfDoubles
#include "shared/frame/projection.h"
#undef PROJECTION_SCALAR
#undef PROJECTION_NAME

/// What the plane `position` of a view is relative to, in a run: what its frame says, or where positions are computed the camera.
glm::dvec3 position_origin(const View& view, bool are_computed);

/// The projection of `view` as a kernel at work on `own` sees it; every `scale`-th pixel of `frame`. `are_computed`: the positions.
/// Differences of places are taken in double.
ProjectionOfDoubles kernel_projection(const Frame& frame, const View& own, const View& view, int scale,
                                      bool are_computed);

ProjectionOfFloats in_floats(const ProjectionOfDoubles& projection);

}  // namespace gloam
