// gloam.Camera
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "base/words.h"
#include "camera/rotations.h"
#include "gloam/arrays.h"
#include "gloam/projection_camera.h"
#include "python/bindings.h"
#include "python/doc_strings.h"

namespace gloam::python {
namespace {

/// A rigid transform, with the axes of a right-handed camera that looks along -z.
struct Rigid {
  glm::dmat3 rotation;
  glm::dvec3 translation;
};

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A square matrix of finite numbers.
Numbers matrix_from(const char* name, const py::object& matrix, py::ssize_t side) {
  const Numbers values = Numbers::ensure(matrix);
  if (!values) {
    PyErr_Clear();
    throw Error("camera: {0} is no matrix; {1} x {1} numbers are allowed", name, side);
  }
  if (values.ndim() != 2 || values.shape(0) != side || values.shape(1) != side)
    throw Error("camera: {0} has the shape {1}; ({2}, {2}) is allowed", name,
                py::cast<std::string>(py::str(values.attr("shape"))), side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (!std::isfinite(values.at(row, column)))
        throw Error("camera: {}[{}, {}] is {}; a finite number is allowed", name, row, column, values.at(row, column));
    }
  }
  return values;
}

bool ends_in_0001(const Numbers& m, bool as_column) {
  const auto at = [&](int i) { return as_column ? m.at(i, 3) : m.at(3, i); };
  return at(0) == 0 && at(1) == 0 && at(2) == 0 && at(3) == 1;
}

Rigid rigid_from(const char* name, const py::object& matrix) {
  const Numbers values = matrix_from(name, matrix, 4);
  Rigid rigid;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rigid.rotation[column][row] = values.at(row, column);
    rigid.translation[row] = values.at(row, 3);
  }
  const bool is_affine = ends_in_0001(values, false);
  if (!is_affine && ends_in_0001(values, true))
    throw Error("camera: {0} is transposed: its translation is in the last row, as for row vectors; give {0}.T", name);
  const std::string fault = is_affine ? rotation_fault(rigid.rotation) : "does not end in the row 0, 0, 0, 1";
  const std::string mirror = fault.empty() && glm::determinant(rigid.rotation) < 0 ? "mirrors the world" : fault;
  if (!mirror.empty())
    throw Error("camera: {} {}; a rotation and a translation of a right-handed camera that looks along -z are allowed",
                name, mirror);
  rigid.rotation = nearest_rotation(rigid.rotation);
  return rigid;
}

/// `axes`: what gloam's view space multiplies those of the matrices by (gloam/projection_camera.h). Of a left-handed view space the pose mirrors
/// a world that is left-handed too, as the pose of a file may.
std::optional<Pose> pose_from(const py::object& camera_to_world, const py::object& world_to_camera,
                              const glm::dvec3& axes = {1, 1, 1}) {
  const glm::dmat3 to_view(axes.x, 0, 0, 0, axes.y, 0, 0, 0, axes.z);
  if (!camera_to_world.is_none() && !world_to_camera.is_none())
    throw Error("camera: camera_to_world and world_to_camera are both given; give one of them");
  if (!camera_to_world.is_none()) {
    const Rigid rigid = rigid_from("camera_to_world", camera_to_world);
    return Pose{to_view * glm::transpose(rigid.rotation), rigid.translation};
  }
  if (world_to_camera.is_none()) return {};
  const Rigid rigid = rigid_from("world_to_camera", world_to_camera);
  return Pose{to_view * rigid.rotation, -(glm::transpose(rigid.rotation) * rigid.translation)};
}

void check_clipping(const Camera& camera) {
  for (const auto& [name, plane] : {std::pair("near", camera.near), std::pair("far", camera.far)}) {
    if (plane && !(camera.orthographic ? std::isfinite(*plane) : *plane > 0))
      throw Error("camera: {} is {}; {} is allowed", name, *plane,
                  camera.orthographic ? "a finite number" : "a number above 0");
  }
  if (camera.near && camera.far && !(*camera.far > *camera.near))
    throw Error("camera: far is {:g}; more than near, {:g}, is allowed", *camera.far, *camera.near);
}

double number(const char* name, const py::object& value) {
  const double number = py::isinstance<py::bool_>(value) ? -1 : PyFloat_AsDouble(value.ptr());
  if (!py::isinstance<py::bool_>(value) && !PyErr_Occurred()) return number;
  const bool is_too_large = !py::isinstance<py::bool_>(value) && PyErr_ExceptionMatches(PyExc_OverflowError);
  PyErr_Clear();
  if (is_too_large) throw UsageError("camera: {} is beyond 1.8e308; a number below is allowed", name);
  throw UsageError("camera: {} is of type {}; a number is allowed", name,
                   py::cast<std::string>(py::type::of(value).attr("__name__")));
}

int whole(const char* name, const py::object& value) {
  const bool is_whole = PyIndex_Check(value.ptr()) && !py::isinstance<py::bool_>(value);
  if (!is_whole)
    throw UsageError("{} is of type {}; a whole number is allowed", name,
                     py::cast<std::string>(py::type::of(value).attr("__name__")));
  const double found = number(name, value);
  if (!(found >= 1 && found <= 65536)) throw UsageError("{} {:g} is not allowed; 1 to 65536 pixels are", name, found);
  return int(found);
}

template <typename Value>
Value chosen(const char* name, const py::object& value, const Choices<Value>& choices) {
  if (!py::isinstance<py::str>(value))
    throw UsageError("{} is of type {}; '{}' is allowed, for example", name,
                     py::cast<std::string>(py::type::of(value).attr("__name__")), choices.front().first);
  return value_of(py::cast<std::string>(value), name, choices);
}

/// What the forms of a camera share: clipping planes, over those that it has, and the pose.
Camera finished(Camera camera, const py::object& near, const py::object& far, const std::optional<Pose>& pose) {
  if (!near.is_none()) camera.near = number("near", near);
  if (!far.is_none()) camera.far = number("far", far);
  camera.pose = pose;
  camera.source = "memory";
  check(camera);
  check_clipping(camera);
  return camera;
}

Camera camera_from(const py::object& fx, const py::object& fy, const py::object& cx, const py::object& cy,
                   bool orthographic, const py::object& near, const py::object& far, const py::object& camera_to_world,
                   const py::object& world_to_camera) {
  Camera camera;
  camera.orthographic = orthographic;
  camera.fx = number("fx", fx), camera.fy = number("fy", fy);
  camera.cx = number("cx", cx), camera.cy = number("cy", cy);
  return finished(camera, near, far, pose_from(camera_to_world, world_to_camera));
}

const Choices<ClipSpace> clip_space_words = {
    {"opengl", ClipSpace::opengl}, {"vulkan", ClipSpace::vulkan}, {"unreal", ClipSpace::unreal}};

Camera from_projection(const py::object& projection, const py::object& convention, const py::object& width,
                       const py::object& height, const py::object& camera_to_world, const py::object& world_to_camera) {
  const ClipSpace clip = chosen("convention", convention, clip_space_words);
  const Numbers values = matrix_from("projection", projection, 4);
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      // Unreal's own are for row vectors.
      const double value = clip == ClipSpace::unreal ? values.at(column, row) : values.at(row, column);
      matrix[column][row] = value;
    }
  }
  const ProjectedCamera made = camera_from_projection(matrix, clip, whole("width", width), whole("height", height));
  return finished(made.camera, py::none(), py::none(), pose_from(camera_to_world, world_to_camera, made.axes));
}

Camera from_intrinsics(const py::object& intrinsics, const py::object& pixel_centre, const py::object& near,
                       const py::object& far, const py::object& camera_to_world, const py::object& world_to_camera) {
  const Numbers k = matrix_from("K", intrinsics, 3);
  if (k.at(2, 0) != 0 || k.at(2, 1) != 0) {
    const bool is_transposed = k.at(0, 2) == 0 && k.at(1, 2) == 0;
    throw UsageError("camera: K has the last row {:g}, {:g}, {:g}; 0, 0, 1 is allowed{}", k.at(2, 0), k.at(2, 1),
                     k.at(2, 2), is_transposed ? ": it is transposed; give K.T" : "");
  }
  if (k.at(2, 2) != 1) throw UsageError("camera: K[2, 2] is {:g}; 1 is allowed", k.at(2, 2));
  if (k.at(0, 1) != 0 || k.at(1, 0) != 0)
    throw UsageError("camera: K has a skew of {:g}; 0 is allowed: rectify the images first", k.at(0, 1) + k.at(1, 0));
  const double centre = number("pixel_centre", pixel_centre);
  if (centre != 0 && centre != 0.5)
    throw UsageError(
        "pixel_centre {:g} is not allowed; 0.5 is, or 0 where K has the middle of the first pixel at (0, 0), as OpenCV",
        centre);
  Camera camera;
  camera.fx = k.at(0, 0), camera.fy = k.at(1, 1);
  camera.cx = k.at(0, 2) + 0.5 - centre, camera.cy = k.at(1, 2) + 0.5 - centre;
  return finished(camera, near, far, pose_from(camera_to_world, world_to_camera));
}

Camera from_fov(const py::object& degrees, const py::object& width, const py::object& height, const py::object& axis,
                const py::object& near, const py::object& far, const py::object& camera_to_world,
                const py::object& world_to_camera) {
  const Choices<bool> axes = {{"horizontal", false}, {"vertical", true}};
  const bool is_vertical = chosen("axis", axis, axes);
  int sides[] = {whole("width", width), whole("height", height)};
  if (is_vertical) std::swap(sides[0], sides[1]);
  Camera camera = camera_with_fov(sides[0], sides[1], number("degrees", degrees));
  if (is_vertical) std::swap(camera.cx, camera.cy);
  return finished(camera, near, far, pose_from(camera_to_world, world_to_camera));
}

py::object camera_to_world(const Camera& camera) {
  if (!camera.pose) return py::none();
  py::array_t<double> matrix({4, 4});
  auto values = matrix.mutable_unchecked<2>();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) values(row, column) = camera.pose->world_to_view[row][column];
    values(row, 3) = camera.pose->position[row];
    values(3, row) = 0;
  }
  values(3, 3) = 1;
  return matrix;
}

std::string camera_in_words(const Camera& camera) {
  std::string words =
      fmt::format("gloam.Camera(fx={:g}, fy={:g}, cx={:g}, cy={:g}", camera.fx, camera.fy, camera.cx, camera.cy);
  if (camera.orthographic) words += ", orthographic=True";
  if (camera.near) words += fmt::format(", near={:g}", *camera.near);
  if (camera.far) words += fmt::format(", far={:g}", *camera.far);
  if (!camera.pose) return words + ")";
  const glm::dvec3& at = camera.pose->position;
  return words + fmt::format(", at ({:g}, {:g}, {:g}))", at.x, at.y, at.z);
}

}  // namespace

void add_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera", camera_help)
      .def(py::init(&camera_from), py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"), py::kw_only(),
           py::arg("orthographic") = false, py::arg("near") = py::none(), py::arg("far") = py::none(),
           py::arg("camera_to_world") = py::none(), py::arg("world_to_camera") = py::none())
      .def_static("from_projection", &from_projection, py::arg("projection"), py::arg("convention"), py::arg("width"),
                  py::arg("height"), py::kw_only(), py::arg("camera_to_world") = py::none(),
                  py::arg("world_to_camera") = py::none(), from_projection_help)
      .def_static("from_intrinsics", &from_intrinsics, py::arg("K"), py::kw_only(), py::arg("pixel_centre") = 0.5,
                  py::arg("near") = py::none(), py::arg("far") = py::none(), py::arg("camera_to_world") = py::none(),
                  py::arg("world_to_camera") = py::none(), from_intrinsics_help)
      .def_static("from_fov", &from_fov, py::arg("degrees"), py::arg("width"), py::arg("height"), py::kw_only(),
                  py::arg("axis") = "horizontal", py::arg("near") = py::none(), py::arg("far") = py::none(),
                  py::arg("camera_to_world") = py::none(), py::arg("world_to_camera") = py::none(), from_fov_help)
      .def_readonly("fx", &Camera::fx)
      .def_readonly("fy", &Camera::fy)
      .def_readonly("cx", &Camera::cx)
      .def_readonly("cy", &Camera::cy)
      .def_readonly("orthographic", &Camera::orthographic)
      .def_readonly("near", &Camera::near)
      .def_readonly("far", &Camera::far)
      .def_property_readonly("camera_to_world", &camera_to_world)
      .def_property_readonly("source", [](const Camera& self) { return text_of(self.source); })
      .def("__repr__", &camera_in_words);
}

}  // namespace gloam::python
