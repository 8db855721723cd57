#include "gloam/arrays.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <utility>

#include "base/lists.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "normalise/depth.h"
#include "normalise/each_row.h"
#include "normalise/normalise.h"
#include "normalise/normals.h"
#include "normalise/radiance.h"
#include "normalise/surfaces.h"

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

void check_array(const std::string& name, std::span<const float> values, int width, int height, size_t components) {
  if (name.empty()) throw Error("a plane without a name; give one of planes.h, such as 'depth'");
  const size_t needed = size_t(width) * size_t(height) * components;
  if (values.size() != needed)
    throw Error("plane '{}' has {} values; {} x {} pixels of {} component{} are {}", name, values.size(), width, height,
                components, components == 1 ? "" : "s", needed);
  if (!values.data()) throw Error("plane '{}' is a null pointer; give its {} values, or leave it out", name, needed);
}

/// Its pixels have no values yet.
Plane unfilled_plane(const std::string& name, const Layout& layout) {
  Plane plane{name, {}};
  for (size_t i = 0; i < plane_kind(name).components.size(); ++i) plane.channels.emplace_back(layout);
  return plane;
}

/// A sentence on a camera that is likely in another unit than the image's pixels; empty if it is not.
std::string note_on_intrinsics(const Camera& camera, int width, int height) {
  const bool is_outside = camera.cx < 0 || camera.cy < 0 || camera.cx > width || camera.cy > height;
  if (is_outside)
    return fmt::format(
        "camera: its principal point ({:g}, {:g}) lies outside of the image of {} x {} pixels; fx, fy, cx and cy are "
        "in "
        "pixels of this image",
        camera.cx, camera.cy, width, height);
  constexpr double widest = 170;
  const double degrees = std::atan(width / 2.0 / camera.fx) * 360 / std::numbers::pi;
  if (camera.orthographic || degrees <= widest) return "";
  return fmt::format(
      "camera: with fx {:g} the image of {} x {} pixels sees {:.1f} degrees; fx, fy, cx and cy are in pixels",
      camera.fx, width, height, degrees);
}

/// Copies a row of an array to that of a plane.
void fill_row(Plane& plane, std::span<const float> values, int y) {
  const size_t components = plane.channels.size();
  const int width = plane.channels.front().layout().width;
  const float* const pixels = values.data() + size_t(y) * size_t(width) * components;
  if (components == 1) {
    std::copy(pixels, pixels + width, plane.channels.front().row(y));
    return;
  }
  if (components == 3) {
    float *a = plane.channels[0].row(y), *b = plane.channels[1].row(y), *c = plane.channels[2].row(y);
    for (int x = 0; x < width; ++x) {
      a[x] = pixels[3 * x];
      b[x] = pixels[3 * x + 1];
      c[x] = pixels[3 * x + 2];
    }
    return;
  }
  for (size_t i = 0; i < components; ++i) {
    float* row = plane.channels[i].row(y);
    for (int x = 0; x < width; ++x) row[x] = pixels[size_t(x) * components + i];
  }
}

/// Planar depth of a depth that something is stated of. Nothing without a depth, or where nothing is stated.
std::optional<Channel> stated_depth(const Arrays& arrays, std::vector<std::string>& notes) {
  const auto depth = arrays.planes.find("depth");
  if (depth == arrays.planes.end() || !states_anything(arrays.depth)) return {};
  const auto given = arrays.planes.find("alpha");
  std::optional<Plane> alpha;
  if (given != arrays.planes.end()) alpha = plane_from("alpha", arrays.width, arrays.height, given->second);
  StatedDepth stated = arrays.depth;
  if (stated.convention == DepthConvention::automatic)
    stated.convention = DepthConvention::z;  // as arrays are asked for
  Plane plane = plane_from("depth", arrays.width, arrays.height, depth->second);
  Channel& channel = plane.channels.front();
  to_view_depth(channel, alpha ? &alpha->channels.front() : nullptr, {0, 0, arrays.width, arrays.height}, arrays.camera,
                stated, notes);
  return std::move(channel);
}

/// What the depth of a view, if it has one, and its normals are found to be. `planar`: the depth, where it had to be converted.
StoredSurfaces stored_surfaces(const Arrays& arrays, const Channel* planar) {
  const auto depth = arrays.planes.find("depth"), normal = arrays.planes.find("normal");
  if (depth == arrays.planes.end()) return {.normals = plain_form(arrays.normals)};
  const float* const values = depth->second.data();
  DepthRows rows{[&](int y) { return values + size_t(y) * size_t(arrays.width); }, arrays.width, arrays.height};
  if (planar) rows = rows_of(*planar);
  std::optional<NormalSamples> samples;
  if (normal != arrays.planes.end()) samples.emplace(Layout(arrays.width, arrays.height)).take(normal->second.data());
  return look_at_surfaces(rows, samples ? &*samples : nullptr, {0, 0, arrays.width, arrays.height}, arrays.camera,
                          {arrays.normals, arrays.depth});
}

/// Values are copied and cleaned row by row: each is then taken from memory once.
View view_from(const Arrays& arrays, LightCounts& light, std::vector<std::string>& notes) {
  View view;
  view.camera = arrays.camera;
  if (view.camera->source.empty()) view.camera->source = "memory";
  const Layout layout(arrays.width, arrays.height);
  std::vector<std::pair<Plane*, std::span<const float>>> sources;
  for (const auto& [name, values] : arrays.planes) {
    check_array(name, values, arrays.width, arrays.height, plane_kind(name).components.size());
    sources.emplace_back(&view.planes.emplace(name, unfilled_plane(name, layout)).first->second, values);
  }
  const std::optional<Channel> planar = stated_depth(arrays, notes);
  const StoredSurfaces stored = stored_surfaces(arrays, planar ? &*planar : nullptr);
  add_new(notes, stored.notes);
  if (const std::string note = note_on_intrinsics(arrays.camera, arrays.width, arrays.height); !note.empty())
    notes.push_back(note);
  if (!stored.are_normals_used) {
    std::erase_if(sources, [](const auto& source) { return source.first->name == "normal"; });
    view.planes.erase("normal");
  }
  const auto fill = [&](Plane& plane, std::span<const float> values, int y) {
    std::vector<Channel>& to = plane.channels;
    const bool is_converted = planar && plane.name == "depth";
    if (is_converted)
      std::copy_n(planar->row(y), layout.width, to[0].row(y));
    else
      fill_row(plane, values, y);
    if (plane.name == "depth") clean_depth_row(to[0].row(y), layout.width, stored.depth.sign, stored.depth.background);
    if (plane.name == "normal" && stored.normals != NormalForm())
      bring_to_view_space(to[0].row(y), to[1].row(y), to[2].row(y), layout.width, stored.normals, *view.camera);
  };
  const Plane *depth = view.find("depth"), *normal = view.find("normal");
  normalise_while_filling(
      view, layout,
      [&](int y) {
        for (const auto& [plane, values] : sources) fill(*plane, values, y);
        light.add_row(view, y, depth ? depth->channels.front().row(y) : nullptr);
      },
      arrays.depth.background);
  if (depth && normal) {
    const long long missing = count_missing_normals(*normal, depth->channels.front());
    if (std::string note = note_on_missing_normals(missing); !note.empty()) notes.push_back(std::move(note));
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
    LightCounts light;
    frame.views.push_back(view_from(arrays, light, frame.assumed));
    add_new(frame.assumed, light.notes());
  } catch (const std::bad_alloc&) {
    throw Error("out of memory for {} planes of {} x {} pixels; use a smaller image", arrays.planes.size(),
                arrays.width, arrays.height);
  }
  return frame;
}

Plane plane_from(const std::string& name, int width, int height, std::span<const float> values) {
  check_array(name, values, width, height, plane_kind(name).components.size());
  Plane plane = unfilled_plane(name, Layout(width, height));
  for_each_row(plane.channels.front().layout(), [&](int y) { fill_row(plane, values, y); });
  return plane;
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
