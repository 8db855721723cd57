#include "frame/check.h"

#include <limits>

#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {

void check_window(const Frame& frame) {
  if (frame.views.empty()) throw Error("the frame has no view; give one at least");
  const long long width = (long long)frame.window.x1 - frame.window.x0,
                  height = (long long)frame.window.y1 - frame.window.y0;
  if (width < 1 || height < 1 || width > std::numeric_limits<int>::max() || height > std::numeric_limits<int>::max())
    throw Error("the frame's window is {} x {} pixels; 1 x 1 and more are allowed", width, height);
}

void check(const Plane& plane, const Frame& frame) {
  const Layout layout = reduced(Layout(frame.width(), frame.height()), resolution_in(plane.name));
  const size_t components = plane_kind(plane.name).components.size();
  if (plane.channels.size() != components)
    throw Error("plane '{}' has {} channels; it needs {}", plane.name, plane.channels.size(), components);
  for (const Channel& channel : plane.channels) {
    if (channel.layout() != layout)
      throw Error("plane '{}' is not the size of the frame: {} x {} pixels, and the frame has {} x {}", plane.name,
                  channel.layout().width, channel.layout().height, layout.width, layout.height);
    if (!channel.data())
      throw Error("plane '{}' has no memory: its channel has been moved to another variable", plane.name);
  }
}

}  // namespace gloam
