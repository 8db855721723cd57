// Section of the page on the frames of a shot.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// Error, time and flicker of each setting, for each source that has a sequence; empty if none has.
std::string sequence_section(const Material& material);

}  // namespace gloam::report
