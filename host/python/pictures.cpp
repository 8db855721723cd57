// gloam.write of a picture
#include <algorithm>

#include "base/files.h"
#include "gloam/plane_picture.h"
#include "picture/picture_path.h"
#include "python/bindings.h"
#include "python/frames.h"
#include "python/interrupts.h"

namespace gloam::python {
namespace {

/// Share of the pixels with a component above 1 from which a picture shows mostly white, which says nothing of the values.
constexpr double most_white = 0.5;

double share_above_one(const Plane& plane, const Plane* depth) {
  const Layout layout = plane.channels.front().layout();
  long long above = 0, surfaces = 0;
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (depth && is_background(depth->channels.front().at(x, y))) continue;
      ++surfaces;
      above +=
          std::any_of(plane.channels.begin(), plane.channels.end(), [&](const Channel& c) { return c.at(x, y) > 1; });
    }
  }
  return surfaces > 0 ? double(above) / double(surfaces) : 0;
}

const Plane* depth_beside(const Plane& plane, const View& view, const HeldFrame* teller) {
  const Plane* depth = view.find("depth");
  if (!depth && teller) {
    for (const View& told : teller->frame.views) {
      if (told.name == view.name) depth = told.find("depth");
    }
  }
  return depth && depth != &plane && depth->channels.front().layout() == plane.channels.front().layout() ? depth
                                                                                                         : nullptr;
}

/// Writes a PNG for each view, as the command does. `teller`: a frame whose depth tells the background. Returns notes.
std::vector<std::string> write_pictures(const std::string& path, const HeldFrame& held, const std::string& name,
                                        const HeldFrame* teller) {
  if (const std::string why = why_unwritable(path); !why.empty()) throw Error("{}: cannot be written, {}", path, why);
  const std::vector<std::string> planes = common_planes(held.frame);
  if (std::find(planes.begin(), planes.end(), name) == planes.end())
    throw UsageError("write {}: no plane '{}'{}; there are {}", path, name, suggestion(name, planes),
                     enumerate(planes));
  return without_lock([&](Interrupts&) {
    std::vector<std::string> notes;
    for (const View& view : held.frame.views) {
      const Plane& plane = *view.find(name);
      const Plane* depth = depth_beside(plane, view, teller);
      write_picture(picture_path(path, view.name, held.frame.views.size() > 1), plane, depth);
      const double share = share_above_one(plane, depth);
      if (share >= most_white && notes.empty())
        notes.push_back(
            fmt::format("write {}: {:.0f} % of the pixels of '{}' are above 1, and white: a picture shows 0 to 1", path,
                        100 * share, name));
    }
    return notes;
  });
}

}  // namespace

void add_pictures(py::module_& module) { module.def("write_pictures", &write_pictures); }

}  // namespace gloam::python
