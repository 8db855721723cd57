// Light-field displays as JSON (docs/light-field.md).
#pragma once

#include <filesystem>
#include <string>

#include "gloam/light_field.h"

namespace gloam {

/// Reads a display JSON. Throws Error naming the file, the field and what is expected for what is missing, of the wrong type or
/// not finite, and for a display that cannot be: without modules, with a screen behind its observers, with modules before the
/// screen, with a transform that is singular or mirrors.
LightFieldDisplay read_display(const std::filesystem::path& file);

/// The same from text; `name`: of where it is from, for messages.
LightFieldDisplay display_from_text(const std::string& text, const std::string& name);

/// JSON of a display, its modules one by one: what `display_from_text` reads as the same display.
std::string text_of(const LightFieldDisplay& display);

/// Whether a JSON text is an object with modules, as a display's is and a camera's is not.
bool is_display_text(const std::string& text);

}  // namespace gloam
