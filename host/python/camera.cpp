// gloam.Camera
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "camera/rotations.h"
#include "python/bindings.h"
#include "python/doc_strings.h"

namespace gloam::python {
namespace {

/// A rigid transform, with the axes of a right-handed camera that looks along -z.
struct Rigid {
  glm::dmat3 rotation;
  glm::dvec3 translation;
};

Rigid rigid_from(const char* name, const py::object& matrix) {
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(matrix);
  if (!values) {
    PyErr_Clear();
    throw Error("camera: {} is no matrix; 4 x 4 numbers are allowed", name);
  }
  if (values.ndim() != 2 || values.shape(0) != 4 || values.shape(1) != 4)
    throw Error("camera: {} has the shape {}; (4, 4) is allowed", name,
                py::cast<std::string>(py::str(values.attr("shape"))));
  Rigid rigid;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rigid.rotation[column][row] = values.at(row, column);
    rigid.translation[row] = values.at(row, 3);
  }
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      if (!std::isfinite(values.at(row, column)))
        throw Error("camera: {}[{}, {}] is {}; a finite number is allowed", name, row, column, values.at(row, column));
    }
  }
  const bool is_affine = values.at(3, 0) == 0 && values.at(3, 1) == 0 && values.at(3, 2) == 0 && values.at(3, 3) == 1;
  const std::string fault = is_affine ? rotation_fault(rigid.rotation) : "does not end in the row 0, 0, 0, 1";
  const std::string mirror = fault.empty() && glm::determinant(rigid.rotation) < 0 ? "mirrors the world" : fault;
  if (!mirror.empty())
    throw Error("camera: {} {}; a rotation and a translation of a right-handed camera that looks along -z are allowed",
                name, mirror);
  rigid.rotation = nearest_rotation(rigid.rotation);
  return rigid;
}

std::optional<Pose> pose_from(const py::object& camera_to_world, const py::object& world_to_camera) {
  if (!camera_to_world.is_none() && !world_to_camera.is_none())
    throw Error("camera: camera_to_world and world_to_camera are both given; give one of them");
  if (!camera_to_world.is_none()) {
    const Rigid rigid = rigid_from("camera_to_world", camera_to_world);
    return Pose{glm::transpose(rigid.rotation), rigid.translation};
  }
  if (world_to_camera.is_none()) return {};
  const Rigid rigid = rigid_from("world_to_camera", world_to_camera);
  return Pose{rigid.rotation, -(glm::transpose(rigid.rotation) * rigid.translation)};
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

std::optional<double> number_or_none(const char* name, const py::object& value) {
  return value.is_none() ? std::nullopt : std::optional(number(name, value));
}

Camera camera_from(const py::object& fx, const py::object& fy, const py::object& cx, const py::object& cy,
                   bool orthographic, const py::object& near, const py::object& far, const py::object& camera_to_world,
                   const py::object& world_to_camera) {
  Camera camera;
  camera.orthographic = orthographic;
  camera.fx = number("fx", fx), camera.fy = number("fy", fy);
  camera.cx = number("cx", cx), camera.cy = number("cy", cy);
  camera.near = number_or_none("near", near), camera.far = number_or_none("far", far);
  camera.pose = pose_from(camera_to_world, world_to_camera);
  camera.source = "memory";
  check(camera);
  check_clipping(camera);
  return camera;
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
