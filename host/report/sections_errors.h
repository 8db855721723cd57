// Sections of the page on the distances of techniques from the truth, and their causes.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// Each is Markdown with its heading, or empty if nothing was measured for it.
std::string converged_section(const Material& material);
std::string ladder_section(const Material& material);
std::string scales_section(const Material& material);
std::string planes_section(const Material& material);

}  // namespace gloam::report
