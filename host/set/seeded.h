// The seeded part of a set: items that nobody knows before the seed is chosen.
#pragma once

#include <cstdint>

#include "set/recipe.h"

namespace gloam::sets {

/// Items of scenes of the public part, with options of the scenes, cameras and radii that are drawn from the seed, the same on every
/// machine. Effects are those of the public part's frame of the same scene; truths take twice its rays. No hash is frozen.
Recipe seeded_recipe(const Recipe& from, uint64_t seed);

}  // namespace gloam::sets
