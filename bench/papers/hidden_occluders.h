// The layers of occluders that a depth buffer does not show.
#pragma once

#include <vector>

#include "gloam/frame.h"

namespace gloam::bench {

/// Over all pixels of a coarse grid and 8 x 8 positions around each, up to the radius: the number of positions at which the first
/// layer is no occluder and the nearest hidden one lies in layer 1, 2, ... of the peeled layers (index 0: layer 1). An occluder
/// lies within the radius and above the tangent plane. `frame`: depth, normal, peel.
std::vector<long long> layers_of_hidden_occluders(const Frame& frame, double radius);

}  // namespace gloam::bench
