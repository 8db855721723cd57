#include "support/unoptimised.h"

// Those that take less time so, together half; the integrals, with their many samples, would take four times as long.
[[maybe_unused]] const bool unoptimised =
    gloam::test::leave_unoptimised({"All/DepthLayers", "All/OpenDirections", "Bilateral", "CornerMask", "Gaussian",
                                    "LightFieldCamera", "LightFieldReuse", "Multires", "Reflection", "StereoAo",
                                    "StereoReflection", "StochasticDepth", "TemporalReflection"});
