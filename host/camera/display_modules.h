// The optical modules of a display JSON: listed, or evenly placed on a line or an arc.
#pragma once

#include "camera/display_fields.h"
#include "gloam/light_field.h"

namespace gloam {

/// Reads the field "modules" of the document. Throws Error for fields that describe no modules.
void read_modules(const DisplayFields& document, LightFieldDisplay& display);

}  // namespace gloam
