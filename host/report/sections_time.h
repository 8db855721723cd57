// Sections of the page on what the time is spent on, and how it compares with other ways to compute the same.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// Each is Markdown with its heading, or empty where nothing was measured for it.
std::string floor_section(const Material& material);
std::string others_section(const Material& material);

}  // namespace gloam::report
