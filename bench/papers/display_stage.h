// What modules of a light-field display show of a scene, as a stage.
#pragma once

#include <string>
#include <vector>

#include "bench/papers/study.h"
#include "gloam/light_field.h"

namespace gloam::bench {

/// Text of data/displays/eighty.json: 80 modules in a line behind a flat screen.
extern const char* const eighty_modules_json;
LightFieldDisplay eighty_modules();

/// The number of the module in the middle of the line, or right of it.
size_t middle_module(const LightFieldDisplay& display);

/// With what the scene's first camera frames on display.
LightFieldDisplay showing(const LightFieldDisplay& display, const std::string& scene, const Settings& settings);

/// Depth, normal and position of some modules' images; all where none is named. The display says what it shows.
Stage stage_of(const LightFieldDisplay& display, const std::string& scene, const Settings& settings, int width,
               int height, const std::vector<size_t>& modules = {});

/// Some views of a stage as a frame of their own.
Frame views_of(const Frame& frame, const std::vector<size_t>& numbers);

}  // namespace gloam::bench
