// In which layer the occluders lie that a depth buffer does not show.
#pragma once

#include <vector>

#include "gloam/frame.h"

namespace gloam::bench {

/// Over all pixels of a coarse grid and 8 x 8 places around each, up to the radius: where the first layer is no occluder,
/// the number of places whose nearest hidden one lies in layer 1, 2, ... of the peeled layers (index 0: layer 1). An
/// occluder lies within the radius and above the tangent plane. `frame`: depth, normal, peel.
std::vector<long long> layers_of_hidden_occluders(const Frame& frame, double radius);

}  // namespace gloam::bench
