#include "python/requests.h"

#include <nlohmann/json.hpp>

#include "base/lists.h"
#include "exr/read_words.h"
#include "gloam/variants.h"
#include "normalise/depth_encoding.h"
#include "normalise/normal_axes.h"
#include "run/run_words.h"
#include "technique/variant_words.h"

namespace gloam::python {
namespace {

template <typename Value>
Value taken(const py::dict& words, const char* name) {
  return py::cast<Value>(words[name]);
}

/// Whether a keyword was given.
bool has(const py::dict& words, const char* name) { return words.contains(name) && !words[name].is_none(); }

std::string text(const py::dict& words, const char* name) {
  return has(words, name) ? taken<std::string>(words, name) : std::string();
}

std::vector<std::string> names(const py::dict& words, const char* name) {
  return has(words, name) ? taken<std::vector<std::string>>(words, name) : std::vector<std::string>();
}

template <typename Value, typename Target>
void take_choice(const py::dict& words, const char* name, const Choices<Value>& choices, Target& value) {
  if (has(words, name)) value = value_of(taken<std::string>(words, name), name, choices);
}

std::optional<double> above_0(const py::dict& words, const char* name) {
  const auto number = taken<std::optional<double>>(words, name);
  if (number && !(*number > 0)) throw UsageError("{} {:g} is not allowed; a number above 0 is", name, *number);
  return number;
}

/// A camera JSON without a size: the camera is in pixels of the frame.
std::string json_of(const Camera& camera) {
  nlohmann::json json = {
      {"cx", camera.cx}, {"cy", camera.cy}, {"camera_type", camera.orthographic ? "ORTHO" : "PERSP"}};
  if (camera.orthographic && camera.fx != camera.fy)
    throw Error("camera: fx is {:g} and fy {:g}; an orthographic camera for a file has to have square pixels",
                camera.fx, camera.fy);
  if (camera.orthographic)
    json["pixels_per_unit"] = camera.fx;
  else
    json["fx"] = camera.fx, json["fy"] = camera.fy;
  if (camera.near) json["near"] = *camera.near;
  if (camera.far) json["far"] = *camera.far;
  const Pose pose = camera.pose.value_or(Pose());
  json["camera_to_world"] = nlohmann::json::array();
  for (int row = 0; row < 3; ++row) {
    const glm::dvec3 axis = pose.world_to_view[row];
    json["camera_to_world"].push_back({axis.x, axis.y, axis.z, pose.position[row]});
  }
  json["camera_to_world"].push_back({0, 0, 0, 1});
  return json.dump();
}

}  // namespace

PlanRequest plan_request(const py::dict& words) {
  PlanRequest request;
  if (has(words, "technique")) {
    VariantChoice variant;
    take_choice(words, "layers", layers_words, variant.layers);
    take_choice(words, "eyes", eyes_words, variant.both_eyes);
    request.outputs = {variant_name(taken<std::string>(words, "technique"), variant)};
  }
  request.only_outputs = names(words, "outputs");
  request.with = names(words, "extras");
  request.filter = text(words, "filter");
  request.preset = text(words, "preset");
  request.settings = taken<Settings>(words, "settings");
  request.only = text(words, "only");
  request.elsewhere = text(words, "elsewhere");
  request.adaptive = text(words, "adaptive");
  take_choice(words, "resolution", resolution_words, request.resolution);
  return request;
}

RunOptions run_options(const py::dict& words) {
  RunOptions options;
  take_choice(words, "math", math_words, options.math);
  take_choice(words, "real", real_words, options.real);
  if (has(words, "lanes")) options.lanes = taken<int>(words, "lanes");
  if (has(words, "seed")) options.seed = taken<int>(words, "seed");
  if (has(words, "repeat")) options.repeat = taken<int>(words, "repeat");
  if (options.seed < 0) throw UsageError("seed {} is not allowed; 0 and more are", options.seed);
  return options;
}

ReadOptions read_options(const py::dict& words) {
  ReadOptions options;
  if (const std::optional<Camera> camera = given_camera(words)) {
    options.camera_file = "camera";
    options.camera_text = json_of(*camera);
  } else {
    options.camera_file = text(words, "camera");
  }
  if (has(words, "fov")) options.fov_degrees = taken<double>(words, "fov");
  const StatedDepth depth = stated_depth(words);
  options.depth = depth.convention, options.near = depth.near, options.far = depth.far;
  options.background = depth.background;
  options.depth_scale = depth.scale, options.depth_offset = depth.offset;
  take_choice(words, "depth_bytes", depth_bytes_words, options.depth_bytes);
  if (has(words, "depth_encoding"))
    options.depth_encoding = parse_depth_encoding(text(words, "depth_encoding"), "depth_encoding");
  if (has(words, "plane_files"))
    for (const auto& [plane, file] : taken<std::map<std::string, std::string>>(words, "plane_files"))
      options.plane_files[plane] = file;
  options.normals = normal_convention(words);
  options.views = names(words, "views");
  if (has(words, "channels")) options.channels = taken<std::map<std::string, std::string>>(words, "channels");
  if (has(words, "as_stored")) options.as_stored = taken<bool>(words, "as_stored");
  return options;
}

Goal goal_of(const py::dict& words) {
  const bool is_text = py::isinstance<py::str>(words["budget"]);
  Goal goal = is_text ? time_goal(text(words, "budget")) : Goal{.ms = above_0(words, "budget")};
  goal.error = above_0(words, "error");
  return goal;
}

NormalConvention normal_convention(const py::dict& words) {
  NormalConvention normals;
  take_choice(words, "normal_space", normal_space_words, normals.space);
  take_choice(words, "normal_range", normal_range_words, normals.range);
  if (has(words, "normal_axes")) normals.axes = parse_normal_axes(text(words, "normal_axes"), "normal_axes");
  return normals;
}

StatedDepth stated_depth(const py::dict& words) {
  StatedDepth depth;
  take_choice(words, "depth_is", depth_words, depth.convention);
  if (has(words, "near")) depth.near = taken<double>(words, "near");
  if (has(words, "far")) depth.far = taken<double>(words, "far");
  if (has(words, "background")) depth.background = taken<float>(words, "background");
  if (has(words, "depth_scale")) depth.scale = taken<double>(words, "depth_scale");
  if (has(words, "depth_offset")) depth.offset = taken<double>(words, "depth_offset");
  return depth;
}

std::optional<Camera> given_camera(const py::dict& words) {
  if (!has(words, "camera") || !py::isinstance<Camera>(words["camera"])) return {};
  return taken<Camera>(words, "camera");
}

void take_camera(const std::optional<Camera>& camera, Frame& frame) {
  if (!camera) return;
  for (View& view : frame.views) {
    view.camera->source = camera->source;
    if (!camera->pose) view.camera->pose.reset();
  }
}

}  // namespace gloam::python
