#include "gloam/frame.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "base/lists.h"
#include "base/page_pool.h"
#include "frame/check.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

std::vector<std::string> view_names(const Frame& frame) {
  std::vector<std::string> names;
  for (const View& view : frame.views) names.push_back("'" + view.name + "'");
  return names;
}

}  // namespace

void Channel::Free::operator()(float* p) const { give_back_pages(p, bytes); }

Layout reduced(const Layout& layout, int scale) {
  if (scale == 1) return layout;
  return Layout((layout.width + scale - 1) / scale, (layout.height + scale - 1) / scale);
}

Channel::Channel(const Layout& layout)
    : layout_(layout), data_(static_cast<float*>(take_pages(layout.bytes())), Free{layout.bytes()}) {}

Channel::Channel(const Layout& layout, float value) : Channel(layout) {
  std::fill_n(data_.get(), layout_.count(), value);
}

Channel Channel::clone() const {
  if (!data_) return {};
  Channel copy(layout_);
  std::memcpy(copy.data(), data(), layout_.bytes());
  return copy;
}

void Channel::fill_padding(float value) {
  if (!data_) return;
  std::fill_n(data_.get(), size_t(Layout::guard), value);
  for (int y = 0; y < layout_.height; ++y) std::fill(row(y) + layout_.width, row(y) + layout_.pitch, value);
  std::fill_n(data_.get() + layout_.count() - Layout::guard, size_t(Layout::guard), value);
}

Plane Plane::clone() const {
  Plane copy;
  copy.name = name;
  for (const Channel& channel : channels) copy.channels.push_back(channel.clone());
  return copy;
}

const Plane* View::find(const std::string& plane) const {
  const auto found = planes.find(plane);
  return found == planes.end() ? nullptr : &found->second;
}

const View& Frame::view(const std::string& name) const {
  for (const View& view : views)
    if (view.name == name) return view;
  throw Error("view '{}' is not in this frame, which has {}", name, enumerate(view_names(*this)));
}

View& Frame::view(const std::string& name) { return const_cast<View&>(std::as_const(*this).view(name)); }

View without_planes(const View& view) {
  return {.name = view.name,
          .camera = view.camera,
          .camera_before = view.camera_before,
          .origin = view.origin,
          .light = view.light,
          .planes = {}};
}

Frame without_planes(const Frame& frame) {
  Frame copy{.display = frame.display,
             .window = frame.window,
             .views = {},
             .pixel_aspect = frame.pixel_aspect,
             .attributes = frame.attributes,
             .numbers = frame.numbers,
             .assumed = frame.assumed};
  for (const View& view : frame.views) copy.views.push_back(without_planes(view));
  return copy;
}

std::vector<std::string> common_planes(const Frame& frame) {
  std::vector<std::string> names;
  if (frame.views.empty()) return names;
  for (const auto& [name, unused] : frame.views.front().planes) {
    const bool all_have = std::all_of(frame.views.begin(), frame.views.end(),
                                      [&name = name](const View& view) { return view.find(name); });
    if (all_have) names.push_back(name);
  }
  return names;
}

void keep_planes(Frame& frame, const std::vector<std::string>& planes) {
  for (View& view : frame.views)
    std::erase_if(view.planes, [&](const auto& plane) { return !contains(planes, plane.first); });
}

void check(const Frame& frame) {
  check_window(frame);
  for (const View& view : frame.views) {
    if (!view.camera) throw Error("view '{}' has no camera; give one", view.name);
    check(*view.camera);
    for (const auto& [name, plane] : view.planes) {
      if (name != plane.name) throw Error("view '{}': the plane '{}' calls itself '{}'", view.name, name, plane.name);
      check(plane, frame);
    }
  }
}

bool is_background(float depth) { return depth == std::numeric_limits<float>::infinity(); }

}  // namespace gloam
