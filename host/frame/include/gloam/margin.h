// The margin of a frame: pixels around the picture, rendered so that occluders beyond its border count.
#pragma once

#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// The pixels of `window` that the picture shows: those of the display window; all of them where the two have none in common.
Window picture_within(const Window& window, const Window& display);

/// Pixels of a window beside the picture.
struct Margin {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
};
Margin margin_of(const Window& window, const Window& display);

/// "96 pixels on each side", "96 pixels on the left and the right, 54 at the top and the bottom", or all four.
std::string in_words(const Margin& margin);

/// Leaves out all pixels but the picture's.
void leave_out_margin(Frame& frame);

/// What becomes of a frame's margin, as a note; none for a frame without one, and where it is written as asked.
std::vector<std::string> notes_on_margin(const Frame& frame, bool is_written, bool is_asked_for);

/// The part of a channel or a plane, which covers `from`, that lies in `to`. Pixels of `to` outside `from` are of the plane's value outside
/// (planes.h); for a channel, `to` lies within `from`.
Channel part_of(const Channel& channel, const Window& from, const Window& to);
Plane part_of(const Plane& plane, const Window& from, const Window& to);

}  // namespace gloam
