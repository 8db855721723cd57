// Which part of the world a display JSON shows: a matrix, or a box of the world and a box of physical space.
#pragma once

#include <optional>

#include "camera/display_fields.h"
#include "gloam/light_field.h"

namespace gloam {

/// By "world_to_physical" or "region_of_interest" of the document; none where it has neither. Throws Error for a transform that is
/// singular or mirrors.
std::optional<WorldToPhysical> read_world(const DisplayFields& document);

}  // namespace gloam
