// Opens a page in the browser of a person who sits at the machine.
#pragma once

#include <filesystem>

namespace gloam::cli {

/// Whether there is a person to show a page to: standard output is a terminal, a display is there, and so is xdg-open.
bool has_browser();

/// Hands a page to xdg-open, which lives on when gloam ends. Does nothing where it cannot be started.
void open_in_browser(const std::filesystem::path& page);

}  // namespace gloam::cli
