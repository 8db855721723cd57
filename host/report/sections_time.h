// Sections of the page on where the time goes, and how it compares with other programs that compute the same.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// Each is Markdown with its heading, or empty if nothing was measured for it.
std::string floor_section(const Material& material);
std::string others_section(const Material& material);

}  // namespace gloam::report
