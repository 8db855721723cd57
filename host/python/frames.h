// Frames as Python holds them.
#pragma once

#include <string>
#include <vector>

#include "python/bindings.h"

namespace gloam::python {

/// The names of a frame's views.
std::vector<std::string> view_names(const Frame& frame);

/// What one view gives is itself; what several give, a list.
template <typename OfView>
py::object of_views(const Frame& frame, const OfView& of_view) {
  py::list list;
  for (const View& view : frame.views) list.append(of_view(view));
  return list.size() == 1 ? py::object(list[0]) : list;
}

/// A copy with only these planes, as far as the frame has them.
Frame copy_of(const Frame& frame, const std::vector<std::string>& planes);

}  // namespace gloam::python
