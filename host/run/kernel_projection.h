// A view's projection as kernels get it (kernels/shared/both/projection.h).
#pragma once

#include "gloam/frame.h"

namespace gloam {

#define PROJECTION_SCALAR float
#define PROJECTION_NAME ProjectionOfFloats
#include "shared/both/projection.h"
#undef PROJECTION_SCALAR
#undef PROJECTION_NAME
#define PROJECTION_SCALAR double
#define PROJECTION_NAME ProjectionOfDoubles
#include "shared/both/projection.h"
#undef PROJECTION_SCALAR
#undef PROJECTION_NAME

/// Origin of the plane `position` of a view in a run: the frame's, or the camera if positions are computed.
glm::dvec3 position_origin(const View& view, bool are_computed);

/// The projection of `view` for a kernel that runs on `own`, for every `scale`-th pixel of `frame`. `are_computed`: the positions
/// are computed. Differences of positions are taken in double.
ProjectionOfDoubles kernel_projection(const Frame& frame, const View& own, const View& view, int scale,
                                      bool are_computed);

ProjectionOfFloats in_floats(const ProjectionOfDoubles& projection);

}  // namespace gloam
