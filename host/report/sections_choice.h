// Sections of the page on choosing a setting: needs, fronts, and every figure of each scene.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// Each is Markdown with its heading, or empty if nothing was measured for it.
std::string needs_section(const Material& material);
std::string fronts_section(const Material& material);
std::string scenes_section(const Material& material);
/// Presets that take more time than a smaller preset and are farther from the truth.
std::string presets_section(const Material& material);

}  // namespace gloam::report
