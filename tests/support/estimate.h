// An unfiltered estimate of ambient occlusion, and the values of its planes.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test {

/// All settings of both lists, those of `more` last.
Settings joined(Settings settings, const Settings& more);

/// A plan for these planes of a technique, unfiltered, from the planes of the frame.
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

/// The largest distance from open of ao_raw over all pixels.
double largest_occlusion(const Frame& result);

}  // namespace gloam::test
