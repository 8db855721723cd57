// The axes that the components of stored normals lie along.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/conventions.h"

namespace gloam {

/// All 48 ways in which components lie along axes.
const std::vector<NormalAxes>& all_axes();

/// How far axes are from the plain ones. Mirrored axes are further than turned ones where axes are exchanged: y up and z up are turned.
double departure_of(const NormalAxes& axes);

/// "x,-y,z"
std::string in_words(const NormalAxes& axes);
/// Axes by their words; throws UsageError, naming the flag, for others.
std::optional<NormalAxes> parse_normal_axes(const std::string& text, const std::string& flag);

}  // namespace gloam
