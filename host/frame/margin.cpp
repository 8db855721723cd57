#include "gloam/margin.h"

#include <fmt/format.h>

#include <algorithm>

#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

Window in_both(const Window& a, const Window& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

bool is_within(const Window& inner, const Window& outer) { return in_both(inner, outer) == inner; }

void copy_pixels(const Channel& channel, const Window& from, const Window& to, Channel& out) {
  const Window common = in_both(from, to);
  if (common.width() <= 0) return;
  for (int y = common.y0; y < common.y1; ++y)
    std::copy_n(channel.row(y - from.y0) + (common.x0 - from.x0), common.width(),
                out.row(y - to.y0) + (common.x0 - to.x0));
}

}  // namespace

Window picture_within(const Window& window, const Window& display) {
  const Window common = in_both(window, display);
  return common.width() > 0 && common.height() > 0 ? common : window;
}

Margin margin_of(const Window& window, const Window& display) {
  const Window picture = picture_within(window, display);
  return {picture.x0 - window.x0, picture.y0 - window.y0, window.x1 - picture.x1, window.y1 - picture.y1};
}

std::string in_words(const Margin& m) {
  if (m.left == m.right && m.top == m.bottom && m.left == m.top) return fmt::format("{} pixels on each side", m.left);
  if (m.left == m.right && m.top == m.bottom)
    return fmt::format("{} pixels on the left and the right, {} at the top and the bottom", m.left, m.top);
  return fmt::format("{} pixels on the left, {} on the right, {} at the top, {} at the bottom", m.left, m.right, m.top,
                     m.bottom);
}

std::vector<std::string> notes_on_margin(const Frame& frame, bool is_written, bool is_asked_for) {
  const Margin margin = margin_of(frame.window, frame.display);
  const std::string flag = option("keep-margin");
  if (!margin.any()) {
    if (!is_asked_for) return {};
    return {flag + ": the frame has no margin, as no data lies outside its display window"};
  }
  const std::string what = fmt::format("margin: {} beside the display window", in_words(margin));
  if (!is_written) return {fmt::format("{} are not written; {} writes them", what, flag)};
  if (is_asked_for) return {};
  return {what + " are written too, as the next frame goes on from them"};
}

Channel part_of(const Channel& channel, const Window& from, const Window& to) {
  if (from == to) return channel.clone();
  Channel out{Layout(to.width(), to.height())};
  copy_pixels(channel, from, to, out);
  return out;
}

Plane part_of(const Plane& plane, const Window& from, const Window& to) {
  if (from == to) return plane.clone();
  const bool is_all_there = is_within(to, from);
  const float outside = plane_kind(plane.name).outside;
  Plane out{plane.name, {}};
  for (const Channel& channel : plane.channels) {
    const Layout layout(to.width(), to.height());
    out.channels.push_back(is_all_there ? Channel(layout) : Channel(layout, outside));
    copy_pixels(channel, from, to, out.channels.back());
  }
  return out;
}

void leave_out_margin(Frame& frame) {
  const Window picture = picture_within(frame.window, frame.display);
  if (picture == frame.window) return;
  for (View& view : frame.views)
    for (auto& [name, plane] : view.planes) plane = part_of(plane, frame.window, picture);
  frame.window = picture;
}

}  // namespace gloam
