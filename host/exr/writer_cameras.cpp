#include "exr/writer_cameras.h"

#include <OpenEXR/ImfIntAttribute.h>

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string_view>

#include "base/lists.h"
#include "camera/rotations.h"
#include "exr/attributes.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// A number, or a text that is one: Unreal writes all of its values as texts.
std::optional<double> number_or_text(const Imf::Header& header, const std::string& name) {
  if (const auto number = number_attribute(header, name)) return number;
  const std::string text = text_attribute(header, name);
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// A lens of a horizontal field of view. Throws Error if it is not of 1 to 179 degrees.
Camera lens_of(double degrees, const Window& display, double pixel_aspect, const std::string& attribute) {
  if (!(degrees >= 1 && degrees <= 179))
    throw Error("{}: a field of view of {:g} degrees; 1 to 179 make sense", printable(attribute), degrees);
  return camera_from_fov(degrees, display, pixel_aspect, "header");
}

Pose pose_of(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& ahead, const glm::dvec3& position,
             const char* attribute) {
  const glm::dmat3 axes = glm::transpose(glm::dmat3(right, up, -ahead));
  const std::string fault = rotation_fault(axes);
  const bool is_finite = std::isfinite(glm::dot(position, position)) && std::isfinite(glm::determinant(axes));
  if (!is_finite || !fault.empty())
    throw Error("{}: {}, expected a rotation and a translation", attribute, is_finite ? fault : "is not finite");
  return {nearest_rotation(axes), position};
}

// --- V-Ray

/// `cameraFov` is horizontal and in degrees; `cameraTransform` leads from the camera to the world. In headers of files of V-Ray for
/// Maya (vrayInfo/vrayversion says so) the camera looks along its -y with its -z upwards, as Nuke scripts in wide use read it:
/// gist.github.com/kpprt/cb07c3c196c5f4937bde6760b483dc82 after pastebin.com/4vmAmARU (rotateX(-90)). In published headers that
/// lack vrayInfo (from 3ds Max, through vrimg2exr) it looks along its -z with y upwards: x is level and y points up in all of
/// them. Other versions tell the lens alone.
void add_vray_pose(const Imf::Header& header, const Imath::M44d& stored, Camera& camera,
                   std::vector<std::string>& notes) {
  const auto is_zero = [](double a, double b, double c) { return a == 0 && b == 0 && c == 0; };
  // Rows are the images of the axes, as Imath has it, where the last column is 0 0 0 1.
  const Imath::M44d m = is_zero(stored[0][3], stored[1][3], stored[2][3]) ? stored : stored.transposed();
  const auto row = [&](int i) { return glm::dvec3(m[i][0], m[i][1], m[i][2]); };
  const std::string version = text_attribute(header, "vrayInfo/vrayversion");
  if (version.find("Maya") != std::string::npos)
    camera.pose = pose_of(row(0), -row(2), -row(1), row(3), "cameraTransform");
  else if (version.empty())
    camera.pose = pose_of(row(0), row(1), -row(2), row(3), "cameraTransform");
  else
    add_new(notes, "camera: cameraTransform is not used, as its axes are known for V-Ray for Maya alone");
}

std::optional<Camera> vray_camera(const Imf::Header& header, const Window& display, double pixel_aspect,
                                  std::vector<std::string>& notes) {
  const auto degrees = number_attribute(header, "cameraFov");
  const auto transform = matrix_attribute(header, "cameraTransform");
  if (!degrees || !transform) return {};
  const auto* projection = header.findTypedAttribute<Imf::IntAttribute>("cameraProjection");
  if (projection && projection->value() != 0) {
    add_new(notes,
            fmt::format("camera: V-Ray's cameraProjection is {}, which is no perspective: its camera is not used",
                        projection->value()));
    return {};
  }
  Camera camera = lens_of(*degrees, display, pixel_aspect, "cameraFov");
  add_vray_pose(header, *transform, camera, notes);
  add_new(notes, "camera: from V-Ray's attributes in the header (cameraFov, cameraTransform)");
  return camera;
}

// --- Unreal, Movie Render Queue

/// The field of view of the passes, where they agree: unreal/camera/fov or unreal/camera/<pass>/fov.
std::optional<double> unreal_field_of_view(const Imf::Header& header, std::string& name) {
  std::optional<double> degrees;
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string_view candidate = attribute.name();
    if (!candidate.starts_with("unreal/camera/") || !candidate.ends_with("fov")) continue;
    if (candidate.size() < 4 || candidate[candidate.size() - 4] != '/') continue;
    const auto value = number_or_text(header, attribute.name());
    if (!value) continue;
    if (degrees && std::abs(*degrees - *value) > 1e-6) return {};
    degrees = value;
    name = attribute.name();
  }
  return degrees;
}

/// Axes of the camera in Unreal's left-handed world, z upwards: columns ahead (x), right (y), up (z), as in Unreal's
/// FRotationMatrix. Degrees; yaw turns from x to y, pitch upwards, roll clockwise.
glm::dmat3 unreal_axes(double pitch, double yaw, double roll) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  const double sp = std::sin(radians(pitch)), cp = std::cos(radians(pitch));
  const double sy = std::sin(radians(yaw)), cy = std::cos(radians(yaw));
  const double sr = std::sin(radians(roll)), cr = std::cos(radians(roll));
  return {glm::dvec3(cp * cy, cp * sy, sp), glm::dvec3(sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp),
          glm::dvec3(-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp)};
}

/// Movie Render Queue writes texts: unreal/camera/curPos/{x,y,z} in centimetres, curRot/{pitch,yaw,roll} in degrees
/// (GetMetadataFromCameraLocRot in MoviePipelineUtils.cpp), and for each pass the horizontal unreal/camera/<pass>/fov
/// (MoviePipelineDeferredPasses.cpp).
std::optional<Camera> unreal_camera(const Imf::Header& header, const Window& display, double pixel_aspect,
                                    std::vector<std::string>& notes) {
  double values[6];
  const char* names[] = {"curPos/x", "curPos/y", "curPos/z", "curRot/pitch", "curRot/yaw", "curRot/roll"};
  for (size_t i = 0; i < std::size(names); ++i) {
    const auto value = number_or_text(header, std::string("unreal/camera/") + names[i]);
    if (!value) return {};
    values[i] = *value;
  }
  std::string name;
  const auto degrees = unreal_field_of_view(header, name);
  if (!degrees) {
    add_new(notes, "camera: Unreal's attributes in the header tell no field of view, or several; they are not used");
    return {};
  }
  Camera camera = lens_of(*degrees, display, pixel_aspect, name);
  const glm::dmat3 axes = unreal_axes(values[3], values[4], values[5]);
  camera.pose = pose_of(axes[1], axes[2], axes[0], {values[0], values[1], values[2]}, "unreal/camera");
  add_new(notes, "camera: from Unreal's attributes in the header (unreal/camera/...)");
  return camera;
}

// --- Redshift

/// The horizontal field of view, degrees (rs/camera/fov, in older files the text RSCameraFOV). The published scripts for
/// rs/camera/transform disagree on its axes, so the place stays unknown.
std::optional<Camera> redshift_camera(const Imf::Header& header, const Window& display, double pixel_aspect,
                                      std::vector<std::string>& notes) {
  for (const char* name : {"rs/camera/fov", "RSCameraFOV"}) {
    const auto degrees = number_or_text(header, name);
    if (!degrees) continue;
    add_new(
        notes,
        fmt::format("camera: the lens from Redshift's {} in the header; its transform is not used, as its axes are not "
                    "documented",
                    name));
    return lens_of(*degrees, display, pixel_aspect, name);
  }
  return {};
}

}  // namespace

std::optional<Camera> writer_camera(const Imf::Header& header, const Window& display, double pixel_aspect,
                                    std::vector<std::string>& notes) {
  for (const auto find : {vray_camera, unreal_camera, redshift_camera})
    if (const std::optional<Camera> camera = find(header, display, pixel_aspect, notes)) return camera;
  return {};
}

}  // namespace gloam
