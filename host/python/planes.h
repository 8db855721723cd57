// Planes from NumPy arrays, and NumPy arrays from planes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "python/bindings.h"

namespace gloam::python {

/// An array that is read in place.
struct InputArray {
  py::array array;  ///< keeps it alive
  int width = 0, height = 0;
  std::span<const float> values() const { return {static_cast<const float*>(array.data()), size_t(array.size())}; }
};

/// Checks the shape of an array for a plane, which is float32 and C-contiguous: (height, width) or (height, width, components). `what`: for
/// messages, "plane 'depth'". Throws Error in one sentence.
InputArray input_array(const std::string& what, const py::handle& value, size_t components);

/// The layers of a stack, given as one array (layers, height, width).
std::vector<InputArray> input_layers(const std::string& what, const py::handle& value);

/// Values as NumPy holds them: rows without padding, the components of a pixel side by side.
struct Values {
  std::vector<py::ssize_t> shape;  ///< (height, width), or (height, width, components)
  std::shared_ptr<void> owner;
  float* data = nullptr;
};

/// A copy of a plane. Needs no interpreter lock, as what follows.
Values values_of(const Plane& plane);
/// Takes over a plane: without a copy if it has one channel without padding between its rows.
Values values_from(Plane&& plane);

/// An array that owns the values.
py::array array_of(const Values& values);

/// A plane as an array that cannot be written to: of one channel in place, kept alive by `owner`; of several a copy.
py::array read_only_array(const Plane& plane, const py::handle& owner);

}  // namespace gloam::python
