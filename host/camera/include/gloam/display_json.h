// Light-field displays as JSON (docs/light-field.md).
#pragma once

#include <filesystem>
#include <string>

#include "gloam/light_field.h"

namespace gloam {

/// Reads a display JSON. Throws Error naming the file, the field and what is expected if a field is missing, of the wrong type or
/// not finite, and for an impossible display: without modules, with a screen behind its observers, with modules before the screen,
/// with a transform that is singular or mirrors.
LightFieldDisplay read_display(const std::filesystem::path& file);

/// As `read_display`, from text. `name`: its source, for messages.
LightFieldDisplay display_from_text(const std::string& text, const std::string& name);

/// The JSON of a display, module by module; `display_from_text` reads the same display from it.
std::string text_of(const LightFieldDisplay& display);

/// Whether a JSON text is an object with modules, as a display's is and a camera's is not.
bool is_display_text(const std::string& text);

}  // namespace gloam
