// An estimate of ambient occlusion by itself, without a filter, and what its planes hold at a pixel.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test {

/// All settings of both, those of `more` last.
Settings joined(Settings settings, const Settings& more);

/// These planes of a technique, unfiltered, from the planes of the frame.
Plan plan_of(const std::string& technique, const Frame& frame, const Settings& settings = {},
             const std::vector<std::string>& only = {"ao_raw"}, int resolution = 1);
/// Its ao_raw.
Frame raw_of(const std::string& technique, const Frame& frame, const Settings& settings = {},
             const RunOptions& options = {}, int resolution = 1);
/// Its bent_normal and cone.
Frame open_directions_of(const std::string& technique, const Frame& frame, const Settings& settings = {});

float value_at(const Frame& frame, const std::string& plane, int x, int y);
glm::dvec3 vector_at(const Frame& frame, const std::string& plane, int x, int y);
float raw_at(const Frame& result, int x, int y);

/// The largest distance of any pixel's ao_raw from open.
double largest_occlusion(const Frame& result);

}  // namespace gloam::test
