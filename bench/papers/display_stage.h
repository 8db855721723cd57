// Images of a light-field display's modules as a stage.
#pragma once

#include <string>
#include <vector>

#include "gloam/light_field.h"
#include "papers/study.h"

namespace gloam::bench {

/// Text of data/displays/eighty.json: 80 modules in a line behind a flat screen.
extern const char* const eighty_modules_json;
LightFieldDisplay eighty_modules();

/// Number of the module in the middle of the line, or just right of it.
size_t middle_module(const LightFieldDisplay& display);

/// The display with the part of the world that the scene's first camera sees.
LightFieldDisplay showing(const LightFieldDisplay& display, const std::string& scene, const Settings& settings);

/// Depth, normal and position of some modules' images; of all if none is named. The display must state which part of the world it
/// shows.
Stage stage_of(const LightFieldDisplay& display, const std::string& scene, const Settings& settings, int width,
               int height, const std::vector<size_t>& modules = {});

/// Some views of a stage as a frame of their own.
Frame views_of(const Frame& frame, const std::vector<size_t>& numbers);

}  // namespace gloam::bench
