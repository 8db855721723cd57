// Methods that others submitted, beside gloam's own.
#pragma once

#include <string>

#include "report/material.h"

namespace gloam::report {

/// A table for each scene that has submitted rows; empty without any.
std::string submitted_section(const Material& material);

}  // namespace gloam::report
