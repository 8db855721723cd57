// The part of the world that a display JSON shows: a matrix, or a box of the world and a box of physical space.
#pragma once

#include <optional>

#include "camera/display_fields.h"
#include "gloam/light_field.h"

namespace gloam {

/// From the field "world_to_physical" or "region_of_interest"; none if the document has neither. Throws Error for a transform that
/// is singular or mirrors.
std::optional<WorldToPhysical> read_world(const DisplayFields& document);

}  // namespace gloam
