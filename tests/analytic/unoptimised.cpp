#include "support/unoptimised.h"

// Suites that take half the time without optimisation; the integrals, with their many samples, would take four times as long.
[[maybe_unused]] const bool unoptimised =
    gloam::test::leave_unoptimised({"All/DepthLayers", "All/OpenDirections", "Bilateral", "CornerMask", "Gaussian",
                                    "LightFieldCamera", "LightFieldReuse", "Multires", "Reflection", "StereoAo",
                                    "StereoReflection", "StochasticDepth", "TemporalReflection"});
