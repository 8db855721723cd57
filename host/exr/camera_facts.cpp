#include "exr/camera_facts.h"

#include <algorithm>
#include <cmath>

#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/light_field.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

using Json = nlohmann::ordered_json;

/// A module of a light-field display, in the display's units.
Json module_document(const Camera& camera) {
  const TwoSlits& slits = *camera.slits;
  return {{"source", camera.source},
          {"type", "two slits"},
          {"display", display_from_text(*slits.display, "gloamDisplay").name},
          {"module", {slits.module.x, slits.module.y, slits.module.z}},
          {"observer_distance", slits.observer_distance},
          {"depth_of_slit", depth_of_slit(camera)}};
}

Json camera_document(const Camera& camera, const Window& display) {
  if (camera.slits) return module_document(camera);
  Json document = {{"source", camera.source}, {"type", camera.orthographic ? "orthographic" : "perspective"},
                   {"fx", camera.fx},         {"fy", camera.fy},
                   {"cx", camera.cx},         {"cy", camera.cy}};
  if (!camera.orthographic) {
    const double left = std::atan((camera.cx - display.x0) / camera.fx),
                 right = std::atan((display.x1 - camera.cx) / camera.fx);
    document["hfov_deg"] = (left + right) * 57.29577951308232;
  }
  document["near"] = camera.near ? Json(*camera.near) : Json();
  document["far"] = camera.far ? Json(*camera.far) : Json();
  document["position"] =
      camera.pose ? Json{camera.pose->position.x, camera.pose->position.y, camera.pose->position.z} : Json();
  return document;
}

/// Where the camera of a view is from.
Json camera_from(const FrameFile& file, const ReadOptions& options, const std::string& view) {
  const std::optional<Camera> camera = file.camera(view);
  if (!camera) return {};
  if (!options.camera_file.empty() || options.fov_degrees) return "flag";
  const auto residual = file.camera_residual(view);
  if (residual && residual->is_fitted && camera->source == "fitted to positions") return "fit";
  const bool is_of_header = camera->source == file.text_attribute("gloamCamera");
  if (camera->source.starts_with("matrix '") && !is_of_header) return "matrix";
  if (camera->source == "default of the data set" && !is_of_header) return "default";
  // A header may name the JSON that its camera came from.
  const bool is_json = camera->source.ends_with(".json") && !is_of_header;
  return is_json ? "json" : "header";
}

/// A text in Python.
std::string python_text(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Half the eyes' distance to either side, or all of it to one, and for eyes that converge the shift of the lens. Eyes that are
/// turned towards each other end in an error in Blender: the camera's axes would not be those of the frame.
constexpr const char* two_eyes =
    "t = c.data.stereo; eyes = [(n, (dict(CENTER=-.5, LEFT=0, RIGHT=-1)[t.pivot] + i) * t.interocular_distance, "
    "dict(OFFAXIS=1, PARALLEL=0)[t.convergence_mode] / t.convergence_distance) for i, n in enumerate(({}, {}))]; "
    "views = [dict(d, view=n, projection_gl=[[x - (i == 0 and j == 2) * p[0][0] * o * k for j, x in enumerate(r)] for "
    "i, r in "
    "enumerate(p)], camera_to_world=[list(r) for r in m @ type(m).Translation((o, 0, 0))]) for n, o, k in eyes]";

}  // namespace

void add_cameras(const FrameFile& file, const ReadOptions& options, Json& document) {
  Json cameras = Json::object();
  for (const std::string& view : file.views()) {
    const std::optional<Camera> camera = file.camera(view);
    if (!camera) continue;
    const bool is_first = cameras.empty();
    const auto residual = file.camera_residual(view);
    cameras[view] = camera_document(*camera, file.display());
    cameras[view]["residual_pixels"] = residual ? Json(residual->median) : Json();
    if (!is_first) continue;
    document["camera"] = cameras[view];
    document["camera_from"] = camera_from(file, options, view);
    if (!residual) continue;
    document["camera_residual_pixels"] = residual->median;
    document["camera_residual_pixels_99"] = residual->percentile_99;
  }
  document["cameras"] = cameras;
}

std::string camera_line(const Json& camera) {
  if (camera.contains("display"))
    return fmt::format("module of display '{}', {}", camera["display"].get<std::string>(),
                       camera["source"].get<std::string>());
  std::string line = fmt::format("{}, {}", camera["type"].get<std::string>(), camera["source"].get<std::string>());
  if (camera.contains("hfov_deg")) line += fmt::format(", hfov {:.2f} deg", camera["hfov_deg"].get<double>());
  line += fmt::format(", fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f}", camera["fx"].get<double>(),
                      camera["fy"].get<double>(), camera["cx"].get<double>(), camera["cy"].get<double>());
  for (const char* plane : {"near", "far"}) {
    if (!camera[plane].is_null()) line += fmt::format(", {} {:g}", plane, camera[plane].get<double>());
  }
  if (!camera["residual_pixels"].is_null())
    line += fmt::format(", residual {:.2g} pixels", camera["residual_pixels"].get<double>());
  return line;
}

bool is_of_blender(const FrameFile& file) {
  const auto has_text = [&](const char* name) { return !file.text_attribute(name).empty(); };
  return has_text("BlenderMultiChannel") || (has_text("Scene") && has_text("File") && has_text("Date"));
}

std::vector<std::string> lines_for_blender(const FrameFile& file) {
  const std::vector<std::string>& views = file.views();
  const auto is_known = [&](const std::string& view) { return file.camera(view).has_value(); };
  const auto shows = [](const PlaneSource& plane) { return plane.plane == "depth" || plane.plane == "normal"; };
  if (views.size() > 2 || std::any_of(views.begin(), views.end(), is_known)) return {};
  if (std::none_of(file.planes().begin(), file.planes().end(), shows)) return {};
  std::error_code unknown;
  std::filesystem::path json = std::filesystem::absolute(file.path(), unknown);
  json.replace_extension(".camera.json");
  const std::string frame = file.text_attribute("Frame");
  const bool is_number = !frame.empty() && frame.find_first_not_of("0123456789") == std::string::npos;
  const std::string first =
      "import bpy, json; s = bpy.context.scene; r = s.render; " +
      (is_number ? fmt::format("s.frame_set({}); ", std::stoi("0" + frame.substr(0, 8))) : std::string()) +
      "c = s.camera; m = c.matrix_world.normalized(); w, h = [n * r.resolution_percentage // 100 for n in "
      "(r.resolution_x, "
      "r.resolution_y)]";
  const std::string second =
      "p = c.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=w, y=h, scale_x=r.pixel_aspect_x, "
      "scale_y=r.pixel_aspect_y); d = dict(width=w, height=h, near=c.data.clip_start, far=c.data.clip_end)";
  if (views.size() == 1) {
    const std::string one = "; d.update(projection_gl=[list(r) for r in p], camera_to_world=[list(r) for r in m])";
    return {first, second + one, fmt::format("open({}, \"w\").write(json.dumps(d))", python_text(json.string()))};
  }
  const std::string both = fmt::format(fmt::runtime(two_eyes), python_text(views[0]), python_text(views[1]));
  return {first, second + "; " + both,
          fmt::format("open({}, \"w\").write(json.dumps(dict(views=views)))", python_text(json.string()))};
}

}  // namespace gloam
