#include "python/planes.h"

#include <algorithm>
#include <cstdint>

#include "gloam/planes.h"
#include "normalise/each_row.h"

namespace gloam::python {
namespace {

/// "(1080, 1920)"
std::string shape_in_words(const py::array& array) { return py::cast<std::string>(py::str(array.attr("shape"))); }

/// The array behind a value, of float32 in C order, as gloam/_arrays.py makes it; its shape is not looked at.
py::array float_array(const std::string& what, const py::handle& value) {
  const auto array = py::reinterpret_borrow<py::array>(value);
  const bool is_plain = py::isinstance<py::array_t<float, py::array::c_style>>(value) &&
                        reinterpret_cast<std::uintptr_t>(array.data()) % alignof(float) == 0;
  if (!is_plain) throw Error("{} is no aligned array of float32 in C order", what);
  return array;
}

[[noreturn]] void refuse_shape(const std::string& what, const py::array& array, const std::string& allowed) {
  throw Error("{} has the shape {}; {} is allowed", what, shape_in_words(array), allowed);
}

int side(const std::string& what, const py::array& array, py::ssize_t axis) {
  const py::ssize_t length = array.shape(axis);
  if (length < 1 || length > 65536)
    throw Error("{} has the shape {}; 1 to 65536 pixels each way are allowed", what, shape_in_words(array));
  return int(length);
}

}  // namespace

InputArray input_array(const std::string& what, const py::handle& value, size_t components) {
  const py::array array = float_array(what, value);
  const bool has_components = components > 1;
  if (array.ndim() != (has_components ? 3 : 2) || (has_components && array.shape(2) != py::ssize_t(components)))
    refuse_shape(what, array,
                 has_components ? fmt::format("(height, width, {0}) or ({0}, height, width)", components)
                                : "(height, width) or (1, height, width)");
  return {array, side(what, array, 1), side(what, array, 0)};
}

std::vector<InputArray> input_layers(const std::string& what, const py::handle& value) {
  const py::array array = float_array(what, value);
  constexpr py::ssize_t most_layers = 100;
  if (array.ndim() != 3 || array.shape(0) < 1 || array.shape(0) > most_layers)
    refuse_shape(what, array, fmt::format("(layers, height, width) with 1 to {} layers", most_layers));
  std::vector<InputArray> layers;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const py::array layer = array[py::int_(i)];
    layers.push_back({layer, side(what, array, 2), side(what, array, 1)});
  }
  return layers;
}

Values values_of(const Plane& plane) {
  const Layout layout = plane.channels.front().layout();
  const py::ssize_t components = py::ssize_t(plane.channels.size());
  Values values{{layout.height, layout.width}, {}, nullptr};
  if (components > 1) values.shape.push_back(components);
  std::shared_ptr<float[]> memory(new float[size_t(layout.width) * size_t(layout.height) * size_t(components)]);
  for_each_row(layout, [&](int y) {
    for (py::ssize_t i = 0; i < components; ++i) {
      const float* row = plane.channels[size_t(i)].row(y);
      float* value = memory.get() + size_t(y) * size_t(layout.width) * size_t(components) + i;
      for (int x = 0; x < layout.width; ++x) value[x * components] = row[x];
    }
  });
  values.data = memory.get();
  values.owner = std::move(memory);
  return values;
}

Values values_from(Plane&& plane) {
  const Layout layout = plane.channels.front().layout();
  if (plane.channels.size() > 1 || layout.pitch != layout.width) return values_of(plane);
  auto channel = std::make_shared<Channel>(std::move(plane.channels.front()));
  float* const data = channel->row(0);
  return {{layout.height, layout.width}, std::move(channel), data};
}

py::array array_of(const Values& values) {
  const py::capsule owner(new std::shared_ptr<void>(values.owner),
                          [](void* held) { delete static_cast<std::shared_ptr<void>*>(held); });
  return py::array_t<float>(values.shape, values.data, owner);
}

py::array read_only_array(const Plane& plane, const py::handle& owner) {
  py::array array;
  if (plane.channels.size() == 1) {
    const Channel& channel = plane.channels.front();
    const Layout& layout = channel.layout();
    array = py::array_t<float>({layout.height, layout.width}, {layout.pitch * sizeof(float), sizeof(float)},
                               channel.row(0), owner);
  } else {
    array = array_of(values_of(plane));
  }
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace gloam::python
