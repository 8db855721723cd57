#include "gloam/arrays.h"

#include <new>
#include <utility>

#include "camera/field_of_view.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

constexpr int longest_side = 65536;

void check_size(int width, int height) {
  const bool is_allowed = width >= 1 && height >= 1 && width <= longest_side && height <= longest_side &&
                          (long long)width * height <= max_pixels;
  if (!is_allowed)
    throw Error("an image of {} x {} pixels is not allowed; 1 to {} each way and {} in all are", width, height,
                longest_side, max_pixels);
}

void check_array(const std::string& name, std::span<const float> values, const Arrays& arrays, size_t components) {
  if (name.empty()) throw Error("a plane without a name; give one of planes.h, such as 'depth'");
  const size_t needed = size_t(arrays.width) * size_t(arrays.height) * components;
  if (values.size() != needed)
    throw Error("plane '{}' has {} values; {} x {} pixels of {} component{} are {}", name, values.size(), arrays.width,
                arrays.height, components, components == 1 ? "" : "s", needed);
  if (!values.data()) throw Error("plane '{}' is a null pointer; give its {} values, or leave it out", name, needed);
}

Channel component_of(std::span<const float> values, const Layout& layout, size_t component, size_t components) {
  Channel channel(layout);
  const float* value = values.data() + component;
  for (int y = 0; y < layout.height; ++y) {
    float* row = channel.row(y);
    for (int x = 0; x < layout.width; ++x, value += components) row[x] = *value;
  }
  return channel;
}

View view_from(const Arrays& arrays) {
  View view;
  view.camera = arrays.camera;
  if (view.camera->source.empty()) view.camera->source = "memory";
  const Layout layout(arrays.width, arrays.height);
  for (const auto& [name, values] : arrays.planes) {
    const size_t components = plane_kind(name).components.size();
    check_array(name, values, arrays, components);
    Plane plane{name, {}};
    for (size_t i = 0; i < components; ++i) plane.channels.push_back(component_of(values, layout, i, components));
    view.planes.emplace(name, std::move(plane));
  }
  return view;
}

}  // namespace

Camera camera_with_fov(int width, int height, double degrees) {
  check_size(width, height);
  return camera_from_fov(degrees, {0, 0, width, height}, 1, "field of view");
}

Frame frame_from(const Arrays& arrays) {
  check_size(arrays.width, arrays.height);
  check(arrays.camera);
  Frame frame;
  frame.display = frame.window = {0, 0, arrays.width, arrays.height};
  try {
    frame.views.push_back(view_from(arrays));
    normalise(frame);
  } catch (const std::bad_alloc&) {
    throw Error("out of memory for {} planes of {} x {} pixels; use a smaller image", arrays.planes.size(),
                arrays.width, arrays.height);
  }
  return frame;
}

std::vector<float> values_of(const Frame& frame, const std::string& plane, const std::string& view) {
  const View& found = frame.view(view);
  const Plane* const held = found.find(plane);
  if (!held) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : found.planes) names.push_back(name);
    throw Error("view '{}' has no plane '{}'; it has {}", view, plane, names.empty() ? "none" : enumerate(names));
  }
  const size_t components = held->channels.size();
  std::vector<float> values(size_t(frame.width()) * size_t(frame.height()) * components);
  for (size_t i = 0; i < components; ++i) {
    float* value = values.data() + i;
    for (int y = 0; y < frame.height(); ++y) {
      const float* row = held->channels[i].row(y);
      for (int x = 0; x < frame.width(); ++x, value += components) *value = row[x];
    }
  }
  return values;
}

}  // namespace gloam
