#include "camera/camera_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string_view>

#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Renderers write matrices as floats: a rotation may be off by their rounding, not by more.
constexpr double rotation_tolerance = 1e-4;
/// A camera is a few kilobytes; a larger JSON is something else.
constexpr std::uintmax_t largest_camera_file = 16 << 20;

// --- Rotations

/// The largest element of m^T m - 1: 0 for a rotation, mirrored or not.
double distance_from_rotation(const glm::dmat3& m) {
  const glm::dmat3 residual = glm::transpose(m) * m - glm::dmat3(1.0);
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::fmax(largest, std::abs(residual[i][j]));
  return largest;
}

/// The orthonormal matrix nearest to `m`, by Newton's iteration for the polar decomposition: it favours no axis, and
/// from float rounding it converges to double precision in two steps.
glm::dmat3 nearest_rotation(glm::dmat3 m) {
  for (int i = 0; i < 4; ++i) m = 0.5 * (m + glm::transpose(glm::inverse(m)));
  return m;
}

/// What is wrong with `m` as a rotation, as the end of a sentence; empty when it is one, mirrored or not.
std::string rotation_fault(const glm::dmat3& m) {
  if (distance_from_rotation(m) <= rotation_tolerance) return "";
  const double x = glm::length(m[0]), y = glm::length(m[1]), z = glm::length(m[2]);
  const double largest = std::max({x, y, z});
  if (!(std::abs(glm::determinant(m)) > 1e-12 * largest * largest * largest)) return "is singular";
  if (distance_from_rotation(m / x) <= rotation_tolerance) return fmt::format("scales by {:.6g}", x);
  return "scales or shears its axes";
}

// --- Finding the file

/// File name without `.json` and without a `.camera` before it.
std::string camera_stem(const fs::path& file) {
  std::string stem = file.stem().string();
  if (stem.ends_with(".camera")) stem.resize(stem.size() - std::string_view(".camera").size());
  return stem;
}

bool has_camera_name(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("camera") || name.ends_with(".camera.json");
}

bool holds_camera(const json& value) {
  if (!value.is_object()) return false;
  constexpr std::array fields = {"camera_to_world", "world_to_camera", "projection_gl", "fx", "pixels_per_unit"};
  return std::any_of(fields.begin(), fields.end(), [&](const char* field) { return value.contains(field); });
}

/// Throws Error naming the file.
json parse_json(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (!failed && size > largest_camera_file) throw Error("{}: {} bytes, too large for a camera", file.string(), size);
  return json_of_text(read_text(file), file.string());
}

/// Whether a JSON without a camera's name holds one all the same. Other JSON files lie beside frames too, gloam's own
/// reports among them, so anything that does not mean to be a camera is passed over in silence; `why_not` is filled
/// where it may have meant to.
bool looks_like_camera(const fs::path& file, std::string& why_not) {
  try {
    const json document = parse_json(file);
    if (!document.is_object()) return false;
    const auto views = document.find("views");
    if (views == document.end()) return holds_camera(document);
    if (views->is_array() && !views->empty() && holds_camera(views->front())) return true;
    if (!document.contains("planes")) why_not = "its \"views\" is no list of cameras";  // `gloam info` writes planes
  } catch (const Error& error) {
    const std::string message = error.what(), name = printable(file.string()) + ": ";
    why_not = message.starts_with(name) ? message.substr(name.size()) : message;
  }
  return false;
}

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    std::error_code unknown;
    if (entry->path().extension() == ".json" && entry->is_regular_file(unknown)) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<fs::path> only_one(const std::vector<fs::path>& candidates, const fs::path& frame) {
  if (candidates.empty()) return {};
  if (candidates.size() == 1) return candidates.front();
  throw Error("{}: both {} and {} could be its camera; say which with --camera", frame.string(),
              candidates[0].filename().string(), candidates[1].filename().string());
}

// --- Fields of the JSON

/// Where the fields of one view are looked up: in the view itself, then at the top of the document.
struct Fields {
  std::string file;
  std::string prefix;  ///< how messages name the view: "views[1]."; empty where the document is the view
  const json& view;
  const json& top;
};

/// The field, or nullptr where it is missing or null.
const json* find(const Fields& fields, const char* name) {
  for (const json* level : {&fields.view, &fields.top}) {
    const auto field = level->find(name);
    if (field != level->end() && !field->is_null()) return &*field;
  }
  return nullptr;
}

[[noreturn]] void refuse(const Fields& fields, const std::string& name, const std::string& fault,
                         const std::string& expected) {
  const std::string field = name.substr(0, name.find('['));
  const bool at_top = !fields.view.contains(field) && fields.top.contains(field);
  throw Error("{}: {}{} {}; expected {}", fields.file, at_top ? "" : fields.prefix, name, fault, expected);
}

std::string type_of(const json& value) { return fmt::format("is of type {}", value.type_name()); }

std::optional<double> number(const Fields& fields, const char* name) {
  const json* field = find(fields, name);
  if (!field) return {};
  if (is_nonfinite_literal(*field)) refuse(fields, name, "is not finite", "a number");
  if (!field->is_number()) refuse(fields, name, type_of(*field), "a number");
  const double value = field->get<double>();
  if (!std::isfinite(value)) refuse(fields, name, "is not finite", "a number");
  return value;
}

std::optional<double> positive(const Fields& fields, const char* name) {
  const std::optional<double> value = number(fields, name);
  if (value && !(*value > 0)) refuse(fields, name, fmt::format("is {:g}", *value), "a number > 0");
  return value;
}

std::optional<std::string> text(const Fields& fields, const char* name) {
  const json* field = find(fields, name);
  if (!field) return {};
  if (!field->is_string()) refuse(fields, name, type_of(*field), "a text");
  return field->get<std::string>();
}

/// A 4x4 matrix written row by row, for column vectors; `m[column][row]` as in GLM.
std::optional<glm::dmat4> matrix(const Fields& fields, const char* name) {
  const json* field = find(fields, name);
  if (!field) return {};
  const auto is_row = [](const json& row) { return row.is_array() && row.size() == 4; };
  if (!field->is_array() || field->size() != 4 || !std::all_of(field->begin(), field->end(), is_row))
    refuse(fields, name, "is not 4 rows of 4", "a 4x4 matrix of numbers, row by row");
  glm::dmat4 m(0.0);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const json& element = (*field)[row][column];
      const bool usable = element.is_number() && std::isfinite(element.get<double>());
      if (!usable)
        refuse(fields, fmt::format("{}[{}][{}]", name, row, column),
               is_nonfinite_literal(element) ? "is not finite" : type_of(element), "a finite number");
      m[column][row] = element.get<double>();
    }
  return m;
}

// --- A camera from its fields

/// A rigid transform between world and camera: what is left of a 4x4 matrix once it has been checked.
struct Rigid {
  glm::dmat3 rotation;
  glm::dvec3 translation;
};

Rigid rigid_from(const Fields& fields, const char* name, const glm::dmat4& m) {
  const std::string expected = "a rotation and a translation of a right-handed camera that looks along -z";
  const glm::dvec4 last(m[0][3], m[1][3], m[2][3], m[3][3] - 1);
  if (!(glm::length(last) <= 1e-9)) refuse(fields, name, "has a last row other than 0 0 0 1", expected);
  const glm::dmat3 rotation(m);
  const std::string fault = rotation_fault(rotation);
  if (!fault.empty()) refuse(fields, name, fault, expected);
  if (glm::determinant(rotation) < 0) refuse(fields, name, "mirrors the world (determinant -1)", expected);
  return {nearest_rotation(rotation), glm::dvec3(m[3])};
}

/// camera_to_world is preferred: its translation is the camera's position as written, in full precision.
Pose pose_from(const Fields& fields) {
  if (const auto m = matrix(fields, "camera_to_world")) {
    const Rigid camera_to_world = rigid_from(fields, "camera_to_world", *m);
    return {glm::transpose(camera_to_world.rotation), camera_to_world.translation};
  }
  if (const auto m = matrix(fields, "world_to_camera")) {
    const Rigid world_to_camera = rigid_from(fields, "world_to_camera", *m);
    return {world_to_camera.rotation, -(glm::transpose(world_to_camera.rotation) * world_to_camera.translation)};
  }
  refuse(fields, "camera_to_world", "is missing", "it or world_to_camera, a 4x4 matrix");
}

/// Whether the view is orthographic: as camera_type says, else as the other fields tell.
bool is_orthographic(const Fields& fields, const std::optional<glm::dmat4>& projection) {
  if (const auto type = text(fields, "camera_type")) {
    if (*type == "ORTHO") return true;
    if (*type == "PERSP") return false;
    refuse(fields, "camera_type", fmt::format("is {}", *type), "PERSP or ORTHO (panoramas cannot be used)");
  }
  if (find(fields, "fx")) return false;
  if (find(fields, "pixels_per_unit")) return true;
  return projection && (*projection)[2][3] == 0;
}

/// Pixels of the image that the JSON describes.
struct Size {
  double width, height;
};

/// Intrinsics from an OpenGL projection: clip space -1..1, y up.
Camera camera_from_projection(const Fields& fields, glm::dmat4 m, bool orthographic, const Size& size) {
  const std::string expected = orthographic ? "an OpenGL orthographic matrix" : "an OpenGL perspective matrix";
  const double w = orthographic ? m[3][3] : -m[2][3], other = orthographic ? m[2][3] : m[3][3];
  const bool is_camera = w != 0 && other == 0 && m[0][3] == 0 && m[1][3] == 0 && m[1][0] == 0 && m[0][1] == 0;
  if (!is_camera) refuse(fields, "projection_gl", "mixes its axes", expected);
  m /= w;
  if (!(m[0][0] > 0 && m[1][1] > 0)) refuse(fields, "projection_gl", "has no positive scale in x and y", expected);
  Camera camera;
  camera.orthographic = orthographic;
  camera.fx = m[0][0] * size.width / 2;
  camera.fy = m[1][1] * size.height / 2;
  const double shift_x = orthographic ? m[3][0] : -m[2][0], shift_y = orthographic ? m[3][1] : -m[2][1];
  camera.cx = size.width / 2 * (1 + shift_x);
  camera.cy = size.height / 2 * (1 - shift_y);
  return camera;
}

/// Beyond these no picture was taken, and what kernels compute from it leaves the range or the digits of a float.
bool is_sensible_scale(double pixels, bool orthographic) {
  return orthographic ? pixels >= 1e-12 && pixels <= 1e12 : pixels >= 1e-6 && pixels <= 1e7;
}

const char* sensible_scale(bool orthographic) {
  return orthographic ? "1e-12 to 1e12 pixels per unit" : "1e-6 to 1e7 pixels";
}

/// Pixels from the corner of the image: what lies further to the side is no place that a lens shift or a crop leads to.
constexpr double farthest_centre = 1e6;

void check_range(const Fields& fields, const Camera& camera) {
  if (!is_sensible_scale(camera.fx, camera.orthographic))
    refuse(fields, camera.orthographic ? "pixels_per_unit" : "fx", fmt::format("is {:g}", camera.fx),
           sensible_scale(camera.orthographic));
  if (!is_sensible_scale(camera.fy, camera.orthographic))
    refuse(fields, camera.orthographic ? "pixels_per_unit" : "fy", fmt::format("is {:g}", camera.fy),
           sensible_scale(camera.orthographic));
  if (!(std::abs(camera.cx) <= farthest_centre))
    refuse(fields, "cx", fmt::format("is {:g}", camera.cx), "at most 1e6 pixels to either side");
  if (!(std::abs(camera.cy) <= farthest_centre))
    refuse(fields, "cy", fmt::format("is {:g}", camera.cy), "at most 1e6 pixels up or down");
}

/// Intrinsics in pixels of `size`: the fields in pixels where they are there, the rest from the projection.
Camera intrinsics_from(const Fields& fields, const Size& size) {
  const std::optional<glm::dmat4> projection = matrix(fields, "projection_gl");
  const bool orthographic = is_orthographic(fields, projection);
  Camera camera;
  camera.orthographic = orthographic;
  if (projection) camera = camera_from_projection(fields, *projection, orthographic, size);
  if (orthographic) {
    // One number for both axes; where pixels are not square the projection tells how much they differ.
    const std::optional<double> scale = positive(fields, "pixels_per_unit");
    const double aspect = projection ? camera.fy / camera.fx : 1;
    camera.fx = scale.value_or(camera.fx);
    camera.fy = camera.fx * aspect;
    if (!scale && !projection) refuse(fields, "pixels_per_unit", "is missing", "it or projection_gl");
  } else {
    const std::optional<double> fx = positive(fields, "fx"), fy = positive(fields, "fy");
    if (!projection && !fx) refuse(fields, "fx", "is missing", "it or projection_gl");
    if (!projection && !fy) refuse(fields, "fy", "is missing", "it or projection_gl");
    camera.fx = fx.value_or(camera.fx);
    camera.fy = fy.value_or(camera.fy);
  }
  const std::optional<double> cx = number(fields, "cx"), cy = number(fields, "cy");
  if (!projection && !cx) refuse(fields, "cx", "is missing", "it or projection_gl");
  if (!projection && !cy) refuse(fields, "cy", "is missing", "it or projection_gl");
  camera.cx = cx.value_or(camera.cx);
  camera.cy = cy.value_or(camera.cy);
  check_range(fields, camera);
  return camera;
}

void add_clipping(const Fields& fields, Camera& camera) {
  camera.near = camera.orthographic ? number(fields, "near") : positive(fields, "near");
  camera.far = camera.orthographic ? number(fields, "far") : positive(fields, "far");
  if (camera.near && camera.far && !(*camera.far > *camera.near))
    refuse(fields, "far", fmt::format("is {:g}", *camera.far), fmt::format("more than near, {:g}", *camera.near));
}

/// The size the JSON was made for; that of the display where it says none. Another aspect is another picture.
Size size_from(const Fields& fields, const Window& display) {
  const double width = positive(fields, "width").value_or(display.width());
  const double height = positive(fields, "height").value_or(display.height());
  // Half-size frames round to whole pixels: one pixel more or less is the same aspect.
  if (std::abs(display.width() * height - display.height() * width) > std::max(width, height))
    refuse(fields, "width", fmt::format("and height are {:g}x{:g}", width, height),
           fmt::format("the aspect of the frame, {}x{}", display.width(), display.height()));
  return {width, height};
}

/// From pixels of the JSON's image to those of the display window.
void fit_to_display(Camera& camera, const Size& size, const Window& display) {
  const double scale_x = display.width() / size.width, scale_y = display.height() / size.height;
  camera.fx *= scale_x;
  camera.fy *= scale_y;
  camera.cx = display.x0 + camera.cx * scale_x;
  camera.cy = display.y0 + camera.cy * scale_y;
}

/// In pixels of the frame too: one of another size than the JSON's takes a camera out of the range.
void check_fit(const Fields& fields, const Camera& camera, const Size& size, const Window& display) {
  const double x = camera.cx - display.x0, y = camera.cy - display.y0;
  if (is_sensible_scale(camera.fx, camera.orthographic) && is_sensible_scale(camera.fy, camera.orthographic) &&
      std::abs(x) <= farthest_centre && std::abs(y) <= farthest_centre)
    return;
  refuse(fields, "width",
         fmt::format("and height are {:g}x{:g}, and for the frame's {}x{} that makes fx {:g} fy {:g} cx {:g} cy {:g}",
                     size.width, size.height, display.width(), display.height(), camera.fx, camera.fy, x, y),
         fmt::format("{}, and a centre of at most 1e6 pixels", sensible_scale(camera.orthographic)));
}

void add_once(std::vector<std::string>& sentences, const std::string& sentence) {
  if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) sentences.push_back(sentence);
}

Camera camera_from(const Fields& fields, const Window& display, std::vector<std::string>& assumed) {
  const Size size = size_from(fields, display);
  Camera camera = intrinsics_from(fields, size);
  add_clipping(fields, camera);
  camera.pose = pose_from(fields);
  camera.source = fs::path(fields.file).filename().string();
  if (size.width != display.width() || size.height != display.height())
    add_once(assumed, fmt::format("camera: {} is for {:g}x{:g} pixels and was scaled to the frame's {}x{}",
                                  camera.source, size.width, size.height, display.width(), display.height()));
  fit_to_display(camera, size, display);
  check_fit(fields, camera, size, display);
  return camera;
}

json parse_camera_file(const fs::path& file) {
  json document = parse_json(file);
  if (!document.is_object())
    throw Error("{}: holds {}, expected an object with \"views\"", file.string(), document.type_name());
  return document;
}

// --- Header matrices

/// Imath's row i is GLM's column i: the same transform, for row vectors there and for column vectors here.
glm::dmat4 columns_of(const Imath::M44d& m) {
  glm::dmat4 result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result[i][j] = m[i][j];
  return result;
}

Imath::M44d rows_of(const glm::dmat4& m) {
  Imath::M44d result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result[i][j] = m[i][j];
  return result;
}

void require_finite(const Imath::M44d& m, const char* name) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) throw Error("{}: element [{}][{}] is not finite", name, i, j);
}

/// From gloam's view space (-z forward) to OpenEXR's camera space (+z forward) and back.
const glm::dmat3 flip_z(1, 0, 0, 0, 1, 0, 0, 0, -1);

Pose pose_from_header(const Imath::M44d& world_to_camera) {
  const glm::dmat4 m = columns_of(world_to_camera);
  if (!(std::abs(m[0][3]) + std::abs(m[1][3]) + std::abs(m[2][3]) + std::abs(m[3][3] - 1) <= 1e-6))
    throw Error("worldToCamera: has a last column other than 0 0 0 1, which is no camera");
  const glm::dmat3 rotation(m);
  const std::string fault = rotation_fault(rotation);
  if (!fault.empty()) throw Error("worldToCamera: {}, expected a rotation and a translation", fault);
  const glm::dmat3 to_camera = nearest_rotation(rotation);
  return {flip_z * to_camera, -(glm::transpose(to_camera) * glm::dvec3(m[3]))};
}

/// Camera space to NDC. The rotation is inverted by transposing it, so that a distant origin costs no digits.
glm::dmat4 camera_to_ndc(const Imath::M44d& world_to_ndc, const Pose& pose) {
  const glm::dmat3 to_world = glm::transpose(flip_z * pose.world_to_view);
  const glm::dmat4 camera_to_world(glm::dvec4(to_world[0], 0), glm::dvec4(to_world[1], 0), glm::dvec4(to_world[2], 0),
                                   glm::dvec4(pose.position, 1));
  return columns_of(world_to_ndc) * camera_to_world;
}

[[noreturn]] void refuse_ndc(const char* fault) { throw Error("worldToNDC: {}", fault); }

/// What a writer's normalised device coordinates are: OpenEXR's 0 to 1 and y down, or with y up, from 0 or from -1.
enum class NdcRange { y_down, y_up, symmetric_y_up };

/// By where the principal point lies: `x`, `y` in NDC. Of a camera that is not shifted it is the middle of the range.
NdcRange range_of(bool y_grows_up, double x, double y) {
  if (!y_grows_up) return NdcRange::y_down;
  return std::hypot(x, y) / 2 < std::hypot(x - 0.5, y - 0.5) ? NdcRange::symmetric_y_up : NdcRange::y_up;
}

/// Intrinsics from `p` = camera to NDC, where p[i][j] is what camera axis i (3: the constant) adds to x, y, z, w.
Camera intrinsics_from_ndc(const glm::dmat4& p, const Window& display, double camera_distance, NdcRange& range) {
  const double slope_x = std::hypot(p[0][0], p[1][0]), slope_y = std::hypot(p[0][1], p[1][1]);
  if (!(slope_x > 0 && slope_y > 0)) refuse_ndc("is singular: it flattens the image");
  // How fast w grows along an axis, against x: 2 tan(fov / 2) for a perspective, 0 for an orthographic camera. No
  // units.
  const double w_sideways = std::hypot(p[0][3], p[1][3]) / slope_x, w_forwards = std::abs(p[2][3]) / slope_x;
  const bool orthographic = w_forwards < 1e-5;
  if (w_sideways > 1e-4 * std::max(w_forwards, 0.1))
    refuse_ndc("tilts the image plane against the viewing axis of worldToCamera");
  const int source = orthographic ? 3 : 2;  // the row that carries the principal point: the constant, or depth
  const double w = p[source][3];
  if (w == 0) refuse_ndc("is singular: it has no w");
  if (std::abs(p[1][0]) > 1e-4 * slope_x || std::abs(p[0][1]) > 1e-4 * slope_y)
    refuse_ndc("shears or turns the image against worldToCamera");
  if (orthographic && (std::abs(p[2][0]) > 1e-4 * slope_x || std::abs(p[2][1]) > 1e-4 * slope_y))
    refuse_ndc("is an oblique projection; expected a perspective or an upright orthographic one");
  // The eye: where w vanishes. Floats in the header move it by their rounding of the camera's distance.
  if (!orthographic && std::abs(p[3][3] / w) > 1e-4 * camera_distance)
    refuse_ndc("has its centre of projection away from the origin of worldToCamera");
  Camera camera;
  camera.orthographic = orthographic;
  const double x = p[source][0] / w, y = p[source][1] / w;
  range = range_of(p[1][1] / w > 0, x, y);
  const bool is_symmetric = range == NdcRange::symmetric_y_up;
  const double scale = is_symmetric ? 0.5 : 1, zero = is_symmetric ? 0.5 : 0;
  const double down = range == NdcRange::y_down ? 1 : -1;
  camera.fx = display.width() * scale * p[0][0] / w;
  camera.fy = -down * display.height() * scale * p[1][1] / w;
  camera.cx = display.x0 + display.width() * (zero + scale * x);
  camera.cy = display.y0 + display.height() * (down > 0 ? y : 1 - zero - scale * y);
  if (!(camera.fx > 0 && camera.fy > 0)) refuse_ndc("mirrors the image: x has to grow to the right");
  if (!std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy)) refuse_ndc("has a w too small for its image");
  return camera;
}

/// Whatever a matrix is scaled by, x has to grow to the right of what is seen: where it does so along -z alone, that is where the
/// camera looks. Of an orthographic camera z tells, and only where y grows up, which OpenEXR's own form does not.
bool looks_along_minus_z(const glm::dmat4& p) {
  const double slope_x = std::hypot(p[0][0], p[1][0]);
  if (std::abs(p[2][3]) >= 1e-5 * slope_x) return p[0][0] / p[2][3] < 0;
  return p[1][1] / p[3][3] > 0 && p[2][2] / p[3][3] < 0;
}

void note_form(NdcRange range, bool looks_back, std::vector<std::string>& assumed) {
  if (range == NdcRange::y_down && !looks_back) return;
  std::string form;
  if (range == NdcRange::symmetric_y_up) form = "worldToNDC as -1 to 1, y up";
  if (range == NdcRange::y_up) form = "worldToNDC as 0 to 1, y up";
  if (looks_back) form += std::string(form.empty() ? "" : ", and ") + "worldToCamera as looking along -z";
  const std::string sentence = fmt::format("camera: the header's matrices tell their form: {}", form);
  if (std::find(assumed.begin(), assumed.end(), sentence) == assumed.end()) assumed.push_back(sentence);
}

/// NDC z is 0 at near and 1 at far. Where they are not known any invertible choice will do: nothing reads it back.
glm::dvec2 ndc_z(const Camera& camera) {
  const double near = camera.near.value_or(camera.orthographic ? 0 : 1);
  const bool has_far = camera.far && std::isfinite(*camera.far) && *camera.far > near;
  if (camera.orthographic) {
    const double range = has_far ? *camera.far - near : 1;
    return {1 / range, -near / range};
  }
  const double scale = has_far ? *camera.far / (*camera.far - near) : 1;
  return {scale, -near * scale};
}

}  // namespace

std::optional<fs::path> find_camera_file(const fs::path& frame, std::vector<std::string>* notes) {
  const std::string frame_name = frame.filename().string();
  const fs::path folder = frame.has_parent_path() ? frame.parent_path() : fs::path(".");
  std::vector<fs::path> by_prefix, by_name;
  std::vector<std::string> no_cameras;
  size_t longest = 0;
  for (const fs::path& file : json_files(folder)) {
    const std::string stem = camera_stem(file);
    const bool named_camera = has_camera_name(file);
    if (file.filename().string().starts_with("camera")) by_name.push_back(file);
    if (stem.empty() || stem.size() < longest || !frame_name.starts_with(stem)) continue;
    std::string why_not;
    if (!named_camera && !looks_like_camera(file, why_not)) {
      if (!why_not.empty())
        no_cameras.push_back(
            fmt::format("camera: {} is there but is no camera ({})", file.filename().string(), why_not));
      continue;
    }
    if (stem.size() > longest) by_prefix.clear();
    longest = stem.size();
    by_prefix.push_back(file);
  }
  if (const auto found = only_one(by_prefix, frame)) return found;
  if (notes) notes->insert(notes->end(), no_cameras.begin(), no_cameras.end());
  return only_one(by_name, frame);
}

std::map<std::string, Camera> read_camera_file(const fs::path& file, const Window& display,
                                               std::vector<std::string>& assumed) {
  const json document = parse_camera_file(file);
  std::map<std::string, Camera> cameras;
  const auto views = document.find("views");
  if (views == document.end() && document.contains("path"))
    throw Error("{}: holds a path of cameras; give it as --camera-path of gloam capture", file.string());
  if (document.contains("modules") && !holds_camera(document))
    throw Error("{}: describes a light-field display and no camera; give it as --display of gloam capture",
                file.string());
  if (views == document.end()) {
    cameras[""] = camera_from({file.string(), "", document, document}, display, assumed);
    return cameras;
  }
  if (!views->is_array() || views->empty())
    throw Error("{}: views {}; expected a list of at least one view", file.string(),
                views->empty() ? "is empty" : type_of(*views));
  for (size_t i = 0; i < views->size(); ++i) {
    const json& view = (*views)[i];
    if (!view.is_object()) throw Error("{}: views[{}] {}; expected an object", file.string(), i, type_of(view));
    const json nothing = json::object();
    const Fields fields{file.string(), fmt::format("views[{}].", i), view, document};
    std::string name = text({fields.file, fields.prefix, view, nothing}, "view").value_or("");
    if (views->size() == 1 || name == "mono") name = "";
    if (!cameras.emplace(name, camera_from(fields, display, assumed)).second)
      refuse(fields, "view", name.empty() ? "is missing or \"mono\"" : fmt::format("is {} again", name),
             "a name that no other view has");
  }
  return cameras;
}

namespace {

/// Between two cameras, at 0 to 1.
Camera between(const Camera& a, const Camera& b, double t) {
  if (t == 0 || t == 1) return t == 0 ? a : b;
  Camera camera = a;
  const auto mixed = [t](double from, double to) { return from + t * (to - from); };
  if (a.near && b.near) camera.near = mixed(*a.near, *b.near);
  if (a.far && b.far) camera.far = mixed(*a.far, *b.far);
  camera.fx = mixed(a.fx, b.fx), camera.fy = mixed(a.fy, b.fy);
  camera.cx = mixed(a.cx, b.cx), camera.cy = mixed(a.cy, b.cy);
  camera.pose->position = a.pose->position + t * (b.pose->position - a.pose->position);
  const glm::dquat from = glm::quat_cast(a.pose->world_to_view), to = glm::quat_cast(b.pose->world_to_view);
  camera.pose->world_to_view = glm::mat3_cast(glm::slerp(from, to, t));
  return camera;
}

}  // namespace

std::vector<Camera> read_camera_path(const fs::path& file, const Window& display, std::vector<std::string>& assumed) {
  const json document = parse_camera_file(file);
  const auto path = document.find("path");
  if (path == document.end() || !path->is_array() || path->size() < 2)
    throw Error("{}: has no path; expected \"path\", a list of two cameras or more", file.string());
  std::vector<Camera> keys;
  for (size_t i = 0; i < path->size(); ++i) {
    const json& entry = (*path)[i];
    if (!entry.is_object()) throw Error("{}: path[{}] {}; expected an object", file.string(), i, type_of(entry));
    keys.push_back(camera_from({file.string(), fmt::format("path[{}].", i), entry, document}, display, assumed));
    if (!keys.back().pose)
      throw Error("{}: path[{}] has no pose; expected camera_to_world or world_to_camera", file.string(), i);
  }
  for (const Camera& key : keys) {
    if (key.orthographic != keys.front().orthographic)
      throw Error("{}: path mixes perspective and orthographic cameras; expected one kind", file.string());
  }
  const std::optional<double> frames = number({file.string(), "", document, document}, "frames");
  if (!frames) return keys;
  if (!(*frames >= 2 && *frames <= 100000) || *frames != std::floor(*frames))
    throw Error("{}: frames {:g} is not allowed; a whole number from 2 to 100000 is", file.string(), *frames);
  std::vector<Camera> cameras;
  for (int i = 0; i < int(*frames); ++i) {
    const double at = double(keys.size() - 1) * i / (*frames - 1);
    const size_t key = std::min(size_t(at), keys.size() - 2);
    cameras.push_back(between(keys[key], keys[key + 1], at - double(key)));
  }
  return cameras;
}

Pose pose_from_matrix(const Imath::M44d& world_to_camera, const glm::dvec3& origin) {
  require_finite(world_to_camera, "worldToCamera");
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(origin[i])) throw Error("gloamOrigin: component {} is not finite", i);
  Pose pose = pose_from_header(world_to_camera);
  pose.position += origin;
  return pose;
}

Camera camera_from_matrices(const Imath::M44d& world_to_camera, const Imath::M44d& world_to_ndc, const Window& display,
                            const glm::dvec3& origin, std::vector<std::string>* assumed) {
  require_finite(world_to_camera, "worldToCamera");
  require_finite(world_to_ndc, "worldToNDC");
  Pose pose = pose_from_header(world_to_camera);
  glm::dmat4 projection = camera_to_ndc(world_to_ndc, pose);
  const bool looks_back = looks_along_minus_z(projection);
  if (looks_back) {
    pose.world_to_view = flip_z * pose.world_to_view;
    projection = camera_to_ndc(world_to_ndc, pose);
  }
  NdcRange range;
  Camera camera = intrinsics_from_ndc(projection, display, glm::length(pose.position), range);
  // OpenEXR's own form, mirrored, looks the same.
  if (looks_back && !camera.orthographic && range == NdcRange::y_up)
    refuse_ndc("mirrors the image: x has to grow to the right");
  if (assumed) note_form(range, looks_back, *assumed);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(origin[i])) throw Error("gloamOrigin: component {} is not finite", i);
  pose.position += origin;
  for (const double scale : {camera.fx, camera.fy})
    if (!is_sensible_scale(scale, camera.orthographic))
      throw Error("worldToNDC: gives {:g} pixels to the unit; {} make sense", scale,
                  sensible_scale(camera.orthographic));
  const double x = camera.cx - display.x0, y = camera.cy - display.y0;
  if (!(std::abs(x) <= farthest_centre && std::abs(y) <= farthest_centre))
    throw Error(
        "worldToNDC: has the principal point at ({:g}, {:g}); at most 1e6 pixels from the image's corner make sense", x,
        y);
  camera.pose = pose;
  camera.source = "header";
  return camera;
}

CameraMatrices matrices_of(const Camera& camera, const Window& display) {
  const Pose pose = camera.pose.value_or(Pose{});
  const glm::dmat4 world_to_camera(flip_z * pose.world_to_view);
  const double width = display.width(), height = display.height();
  const int source = camera.orthographic ? 3 : 2;
  glm::dmat4 projection(0.0);
  projection[0][0] = camera.fx / width;
  projection[1][1] = -camera.fy / height;
  projection[source][0] = (camera.cx - display.x0) / width;
  projection[source][1] = (camera.cy - display.y0) / height;
  projection[source][3] = 1;
  const glm::dvec2 z = ndc_z(camera);
  projection[2][2] = z.x;
  projection[3][2] = z.y;
  return {rows_of(world_to_camera), rows_of(projection * world_to_camera), pose.position};
}

Camera camera_from_fov(double degrees, const Window& display, double pixel_aspect, const std::string& source) {
  if (!(degrees >= 1 && degrees <= 179))
    throw UsageError("{} {:g} is not allowed; a horizontal field of view of 1 to 179 degrees is", source, degrees);
  Camera camera;
  camera.fx = display.width() / 2.0 / std::tan(degrees * std::numbers::pi / 360);
  camera.fy = camera.fx * pixel_aspect;  // lower pixels: more of them on the same length
  camera.cx = (display.x0 + display.x1) / 2.0;
  camera.cy = (display.y0 + display.y1) / 2.0;
  camera.source = source;
  return camera;
}

}  // namespace gloam
