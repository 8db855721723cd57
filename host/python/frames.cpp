// gloam.Frame: frames of arrays, and arrays of frames.
#include "python/frames.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/arrays.h"
#include "gloam/margin.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "gloam/technique.h"
#include "normalise/surfaces.h"
#include "python/doc_strings.h"
#include "python/interrupts.h"
#include "python/planes.h"
#include "python/requests.h"

namespace gloam::python {
namespace {

/// Every plane that a technique, a scene or a file may have.
std::vector<std::string> known_planes() {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) add_new(names, kind.name);
  for (const StackKind& kind : stack_kinds()) add_new(names, kind.name);
  for (const Technique& technique : registry()) {
    for (const auto* list : {&technique.reads, &technique.may_read, &technique.writes, &technique.extras})
      add_new(names, *list);
  }
  return names;
}

/// The arrays of one view, by plane; the layers of a stack are planes of their own.
using InputArrays = std::vector<std::pair<std::string, InputArray>>;

InputArrays arrays_of_view(const py::dict& planes, const std::string& view) {
  InputArrays arrays;
  for (const auto& [key, value] : planes) {
    const std::string name = py::cast<std::string>(key);
    const std::string what =
        view.empty() ? fmt::format("plane '{}'", name) : fmt::format("plane '{}' of view '{}'", name, view);
    if (!is_stack(name)) {
      arrays.emplace_back(name, input_array(what, value, plane_kind(name).components.size()));
      continue;
    }
    std::vector<InputArray> layers = input_layers(what, value);
    for (size_t i = 0; i < layers.size(); ++i) arrays.emplace_back(layer_name(name, int(i)), std::move(layers[i]));
  }
  return arrays;
}

void check_sizes(const std::vector<InputArrays>& views) {
  const auto& [first_name, first] = views.front().front();
  for (const InputArrays& arrays : views) {
    for (const auto& [name, array] : arrays) {
      if (array.width == first.width && array.height == first.height) continue;
      throw Error("plane '{}' is {} x {} pixels, and '{}' is {} x {}; all planes of a frame have one size", name,
                  array.width, array.height, first_name, first.width, first.height);
    }
  }
}

Frame frame_of_view(const InputArrays& inputs, const Camera& camera, const StatedSurfaces& stated) {
  Arrays arrays{.width = inputs.front().second.width,
                .height = inputs.front().second.height,
                .camera = camera,
                .normals = stated.normals,
                .depth = stated.depth};
  for (const auto& [name, input] : inputs) arrays.planes[name] = input.values();
  return frame_from(arrays);
}

StatedSurfaces stated_surfaces(const py::dict& words) { return {normal_convention(words), stated_depth(words)}; }

/// A frame of one view or of several. `planes`: for each view, arrays by name. `notes`: what there is to say of the arrays.
SharedFrame frame_of_arrays(const std::vector<py::dict>& planes, const std::vector<Camera>& cameras,
                            const std::vector<std::string>& names, const py::dict& words,
                            const std::vector<std::string>& notes) {
  std::vector<InputArrays> views;
  for (size_t i = 0; i < planes.size(); ++i) views.push_back(arrays_of_view(planes[i], names[i]));
  check_sizes(views);
  const StatedSurfaces stated = stated_surfaces(words);
  return without_lock([&](Interrupts&) {
    auto held = std::make_shared<HeldFrame>();
    held->frame.assumed = notes;
    for (size_t i = 0; i < views.size(); ++i) {
      Frame one = frame_of_view(views[i], cameras[i], stated);
      one.views.front().name = names[i];
      held->frame.display = one.display;
      held->frame.window = one.window;
      held->frame.views.push_back(std::move(one.views.front()));
      add_new(held->frame.assumed, one.assumed);
    }
    return held;
  });
}

/// Values as they are, without cameras: for `compare`, which must see what was computed, and for `write`.
SharedFrame image_of_arrays(const std::vector<py::dict>& planes, const std::vector<std::string>& names) {
  std::vector<InputArrays> views;
  for (size_t i = 0; i < planes.size(); ++i) views.push_back(arrays_of_view(planes[i], names[i]));
  check_sizes(views);
  return without_lock([&](Interrupts&) {
    auto held = std::make_shared<HeldFrame>();
    const InputArray& first = views.front().front().second;
    held->frame.display = held->frame.window = {0, 0, first.width, first.height};
    for (size_t i = 0; i < views.size(); ++i) {
      View& view = held->frame.views.emplace_back();
      view.name = names[i];
      for (const auto& [name, input] : views[i])
        view.planes[name] = plane_from(name, input.width, input.height, input.values());
    }
    return held;
  });
}

/// Whether a view has the plane, or, of a layer, any layer of its stack: a stack is replaced as a whole.
bool takes_place_of(const View& view, const std::string& name) {
  const std::optional<StackLayer> layer = stack_layer(name);
  return view.find(name) || (layer && view.find(layer_name(layer->stack, 0)));
}

/// A copy of a frame in which these planes join its own, or take their place. `planes`: for each view, arrays by name.
SharedFrame with_planes(const HeldFrame& held, const std::vector<py::dict>& planes, const py::dict& words,
                        const std::vector<std::string>& notes) {
  const StatedSurfaces stated = stated_surfaces(words);
  const SharedFrame more = image_of_arrays(planes, view_names(held.frame));
  const Frame& image = more->frame;
  if (image.width() != held.frame.width() || image.height() != held.frame.height())
    throw Error("the arrays are {} x {} pixels, and the frame has {} x {}; all planes of a frame have one size",
                image.width(), image.height(), held.frame.width(), held.frame.height());
  return without_lock([&](Interrupts&) {
    std::vector<std::string> kept = common_planes(held.frame);
    std::erase_if(kept, [&](const std::string& name) { return takes_place_of(image.views.front(), name); });
    auto joined = std::make_shared<HeldFrame>(HeldFrame{copy_of(held.frame, kept), held.name});
    const bool has_depth = image.views.front().find("depth"), has_normals = image.views.front().find("normal");
    for (size_t i = 0; i < image.views.size(); ++i) joined->frame.views[i].planes.merge(more->frame.views[i].planes);
    if (has_depth || has_normals) settle_surfaces(joined->frame, {has_depth, has_normals}, stated);
    add_new(joined->frame.assumed, notes);
    normalise(joined->frame, has_depth ? stated.depth.background : std::nullopt);
    return joined;
  });
}

const Plane& plane_of(const HeldFrame& held, const View& view, const std::string& name) {
  if (const Plane* plane = view.find(name)) return *plane;
  const std::vector<std::string> planes = common_planes(held.frame);
  throw py::key_error(printable(fmt::format("no plane '{}'{}; {}", name, suggestion(name, planes),
                                            planes.empty() ? "there is none" : "there are " + enumerate(planes))));
}

py::object plane_as_array(const SharedFrame& held, const std::string& name) {
  const py::object owner = py::cast(held);
  return of_views(held->frame, [&](const View& view) { return read_only_array(plane_of(*held, view, name), owner); });
}

/// Slices of rows and columns.
py::tuple picture_of(const Frame& frame) {
  const Window picture = picture_within(frame.window, frame.display);
  const auto slice = [](int from, int to) { return py::slice(from, to, 1); };
  return py::make_tuple(slice(picture.y0 - frame.window.y0, picture.y1 - frame.window.y0),
                        slice(picture.x0 - frame.window.x0, picture.x1 - frame.window.x0));
}

std::string frame_in_words(const HeldFrame& held) {
  std::string words =
      fmt::format("<gloam.Frame {}{} x {} pixels: {}", held.name.empty() ? "" : "'" + printable(held.name) + "', ",
                  held.frame.width(), held.frame.height(), fmt::join(common_planes(held.frame), ", "));
  if (held.frame.views.size() > 1)
    words += fmt::format("; views {}", printable(fmt::format("{}", fmt::join(view_names(held.frame), ", "))));
  return words + ">";
}

}  // namespace

std::vector<std::string> view_names(const Frame& frame) {
  std::vector<std::string> names;
  for (const View& view : frame.views) names.push_back(view.name);
  return names;
}

Frame copy_of(const Frame& frame, const std::vector<std::string>& planes) {
  Frame copy = without_planes(frame);
  for (size_t i = 0; i < frame.views.size(); ++i) {
    for (const std::string& plane : planes) {
      if (const Plane* found = frame.views[i].find(plane)) copy.views[i].planes[plane] = found->clone();
    }
  }
  return copy;
}

void add_frames(py::module_& module) {
  py::class_<HeldFrame, SharedFrame>(module, "Frame", frame_help)
      .def_property_readonly("width", [](const HeldFrame& self) { return self.frame.width(); })
      .def_property_readonly("height", [](const HeldFrame& self) { return self.frame.height(); })
      .def_property_readonly("picture", [](const HeldFrame& self) { return picture_of(self.frame); })
      .def_property_readonly("name", [](const HeldFrame& self) { return text_of(self.name); })
      .def_property_readonly("views", [](const HeldFrame& self) { return texts_of(view_names(self.frame)); })
      .def_property_readonly("planes", [](const HeldFrame& self) { return common_planes(self.frame); })
      .def_property_readonly(
          "camera",
          [](const HeldFrame& self) { return of_views(self.frame, [](const View& view) { return view.camera; }); })
      .def_property_readonly("notes", [](const HeldFrame& self) { return texts_of(self.frame.assumed); })
      .def_property_readonly("attributes",
                             [](const HeldFrame& self) {
                               py::dict attributes;
                               for (const auto& [name, value] : self.frame.attributes)
                                 attributes[text_of(name)] = text_of(value);
                               return attributes;
                             })
      .def_property_readonly("numbers", [](const HeldFrame& self) { return self.frame.numbers; })
      .def("keys", [](const HeldFrame& self) { return common_planes(self.frame); })
      .def("__iter__", [](const HeldFrame& self) { return py::iter(py::cast(common_planes(self.frame))); })
      .def("__len__", [](const HeldFrame& self) { return common_planes(self.frame).size(); })
      .def("__contains__",
           [](const HeldFrame& self, const std::string& plane) { return contains(common_planes(self.frame), plane); })
      .def("__getitem__", &plane_as_array)
      .def("__repr__", &frame_in_words);
  module.def("frame_of_arrays", &frame_of_arrays);
  module.def("image_of_arrays", &image_of_arrays);
  module.def("with_planes", &with_planes);
  module.def("camera_with_fov", &camera_with_fov);
  module.def("known_planes", &known_planes);
  module.def("components", [](const std::string& plane) { return plane_kind(plane).components.size(); });
  module.def("is_unit_interval", [](const std::string& plane) {
    const PlaneKind kind = plane_kind(plane);
    return kind.meaning == PlaneKind::unit_interval;
  });
  module.def("is_stack", [](const std::string& plane) { return is_stack(plane); });
}

}  // namespace gloam::python
