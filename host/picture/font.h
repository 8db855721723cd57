// Letters of a font in files, by FreeType.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "picture/letters.h"

namespace gloam {

/// Two files: of plain and of bold letters.
struct FontFiles {
  std::filesystem::path plain, bold;
};

/// Where Linux distributions keep DejaVu Sans and fonts like it; the first that is there is taken.
const std::vector<FontFiles>& known_fonts();

/// The letters of the first font that can be read. Null if there is none, and in a build without FreeType.
std::unique_ptr<Letters> font_letters(const std::vector<FontFiles>& fonts = known_fonts());

}  // namespace gloam
