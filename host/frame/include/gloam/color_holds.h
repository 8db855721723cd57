// What a frame's colour holds already, so that no light is counted twice.
#pragma once

#include <string>

namespace gloam {

/// Light and shadow that the plane `color` holds. Direct light it always holds.
struct ColorHolds {
  bool ambient = true;      ///< ambient light, such as that of a sky
  bool shadows = true;      ///< shadows of its lights
  bool ao = false;          ///< its ambient light is occluded
  bool indirect = false;    ///< light that surfaces reflect among each other
  bool reflection = false;  ///< what glossy surfaces mirror
  bool operator==(const ColorHolds&) const = default;
};

/// The header's attribute that states it.
inline constexpr const char* color_holds_attribute = "gloamColorHolds";

/// "ambient,shadows" -> those two and nothing else; "none" -> nothing. Throws UsageError that begins with `what` for another word,
/// and for ao without ambient.
ColorHolds parse_color_holds(const std::string& text, const std::string& what);
/// The same as text.
std::string in_words(const ColorHolds& holds);
/// What to tell where neither file nor user says what colour holds.
std::string note_on_assumed_holds();

}  // namespace gloam
