// gloam.Scene, gloam.capture and gloam.reference
#include <array>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/scene/capture.h"
#include "python/frames.h"
#include "python/interrupts.h"
#include "scene/falloff.h"
#include "scene/names.h"
#include "scene/reference_kinds.h"

namespace gloam::python {
namespace {

/// A scene, prepared for rays when they are first asked for.
class HeldScene {
 public:
  explicit HeldScene(Scene scene) : scene_(std::move(scene)) {}
  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const {
    std::call_once(once_, [this] { tracer_.emplace(scene_); });
    return *tracer_;
  }

 private:
  const Scene scene_;
  mutable std::once_flag once_;
  mutable std::optional<Tracer> tracer_;
};
using SharedScene = std::shared_ptr<HeldScene>;

SharedScene load(const std::string& name, const Settings& settings) {
  return without_lock([&](Interrupts&) { return std::make_shared<HeldScene>(load_scene(name, settings)); });
}

/// Where the camera is, as `capture` takes it.
struct Place {
  std::optional<Camera> camera;  ///< given as it is
  std::string name;              ///< a camera of the scene; empty: its first
  std::optional<std::array<double, 3>> eye, target;
  std::optional<double> fov;
};

glm::dvec3 point_of(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

Camera camera_at(const Place& place, const Scene& scene, int width, int height) {
  if (place.eye.has_value() != place.target.has_value())
    throw UsageError("eye and target go together; give both or neither");
  if (place.eye && (place.camera || !place.name.empty()))
    throw UsageError("camera and eye both place the camera; give one of them");
  if (place.fov && !(*place.fov >= 1 && *place.fov <= 179))
    throw UsageError("fov {:g} is not allowed; a number from 1 to 179 is", *place.fov);
  if (place.camera) {
    if (place.fov) throw UsageError("fov and a gloam.Camera cannot be given together; the camera has its focal length");
    if (!place.camera->pose)
      throw UsageError("camera: has no pose, so that its place in the scene is unknown; give camera_to_world");
    return *place.camera;
  }
  SceneCamera chosen = named_camera(scene, place.name);
  if (place.eye)
    chosen = looking_at("eye", point_of(*place.eye), point_of(*place.target),
                        chosen.orthographic ? 60 : chosen.fov_degrees, scene.up);
  if (place.fov && chosen.orthographic) throw UsageError("fov: camera '{}' is orthographic and has none", chosen.name);
  chosen.fov_degrees = place.fov.value_or(chosen.fov_degrees);
  return camera_for(chosen, width, height);
}

Place place_from(const py::dict& words) {
  Place place;
  const py::object camera = words["camera"];
  if (py::isinstance<Camera>(camera))
    place.camera = py::cast<Camera>(camera);
  else if (!camera.is_none())
    place.name = py::cast<std::string>(camera);
  place.eye = py::cast<std::optional<std::array<double, 3>>>(words["eye"]);
  place.target = py::cast<std::optional<std::array<double, 3>>>(words["target"]);
  place.fov = py::cast<std::optional<double>>(words["fov"]);
  return place;
}

CaptureOptions options_from(const py::dict& words) {
  CaptureOptions options;
  options.width = py::cast<int>(words["width"]);
  options.height = py::cast<int>(words["height"]);
  std::tie(options.margin_x, options.margin_y) = py::cast<std::pair<int, int>>(words["margin"]);
  options.planes =
      words["planes"].is_none() ? usual_capture_planes() : py::cast<std::vector<std::string>>(words["planes"]);
  options.peel = py::cast<int>(words["peel"]);
  options.peel_light = py::cast<bool>(words["peel_light"]);
  options.stochastic.samples = py::cast<int>(words["stochastic"]);
  if (const auto stereo = py::cast<std::optional<double>>(words["stereo"]))
    options.stereo = StereoRig{.interpupillary_distance = *stereo,
                               .convergence = py::cast<std::optional<double>>(words["convergence"])};
  else if (!words["convergence"].is_none())
    throw UsageError("convergence is for two eyes; give stereo=DISTANCE too");
  return options;
}

SharedFrame capture_scene(const SharedScene& held, const py::dict& words) {
  CaptureOptions options = options_from(words);
  const Place place = place_from(words);
  if (contains(options.planes, "motion"))
    throw UsageError("planes: motion needs cameras of two moments; gloam capture --shot NAME makes a sequence with it");
  return without_lock([&](Interrupts& interrupts) {
    options.progress = [&](int, int) { interrupts.poll(); };
    options.views = {{.name = "", .camera = camera_at(place, held->scene(), options.width, options.height)}};
    CaptureResult result = capture(held->tracer(), options);
    auto frame = std::make_shared<HeldFrame>(HeldFrame{std::move(result.frame), held->scene().name});
    const double radius = held->scene().ao_radius;
    const std::optional<double> made = radius > 0 ? std::optional(radius) : radius_made_from(frame->frame);
    if (made) frame->frame.numbers["aoRadius"] = *made;
    if (result.surfaces == 0)
      frame->frame.assumed.push_back("nothing of the scene is in the picture; another camera or eye may see it");
    frame->frame.assumed.insert(frame->frame.assumed.end(), held->scene().notes.begin(), held->scene().notes.end());
    return frame;
  });
}

/// The scene that the frame's header names.
SharedScene scene_of(const HeldFrame& frame, const Settings& settings) {
  const auto attribute = frame.frame.attributes.find("gloamScene");
  NamedScene named = scene_in_attribute(attribute == frame.frame.attributes.end() ? "" : attribute->second);
  if (named.name.empty()) throw UsageError("the frame does not say which scene it shows; give scene=...");
  if (!find_builtin_scene(named.name))
    throw UsageError("the frame shows '{}', which is not built in; give scene=... with the file", named.name);
  named.settings.insert(named.settings.end(), settings.begin(), settings.end());
  return load(named.name, named.settings);
}

void check_seed(int seed) {
  if (seed < 0 || seed > 1 << 30)
    throw UsageError("seed {} is not allowed; a whole number from 0 to {} is", seed, 1 << 30);
}

void check_reach(const char* name, std::optional<double> reach) {
  if (reach && !((*reach >= 1e-30 && *reach <= 1e30) || (std::isinf(*reach) && *reach > 0)))
    throw UsageError("{} {:g} is not allowed; a number from 1e-30 to 1e30, or inf, is", name, *reach);
}

std::optional<glm::dvec3> point_from(const py::object& words) {
  const auto values = py::cast<std::optional<std::array<double, 3>>>(words);
  return values ? std::optional(point_of(*values)) : std::nullopt;
}

ReferenceRequest request_from(const py::dict& words) {
  ReferenceRequest request;
  request.what = py::cast<std::string>(words["what"]);
  request.samples = py::cast<std::optional<int>>(words["samples"]);
  request.radius = py::cast<std::optional<double>>(words["radius"]);
  request.falloff = py::cast<std::string>(words["falloff"]);
  request.falloff_settings = py::cast<Settings>(words["falloff_settings"]);
  request.bounces = py::cast<std::optional<int>>(words["bounces"]);
  request.length = py::cast<std::optional<double>>(words["length"]);
  request.light_direction = point_from(words["light_direction"]);
  request.light_position = point_from(words["light_position"]);
  request.light_angle = py::cast<std::optional<double>>(words["light_angle"]);
  request.environment = py::cast<std::string>(words["environment"]);
  const std::string axes = py::cast<std::string>(words["environment_axes"]);
  if (!axes.empty()) request.environment_axes = value_of(axes, "environment_axes", environment_axes());
  request.environment_turn = py::cast<std::optional<double>>(words["environment_turn"]);
  if (const std::string holds = py::cast<std::string>(words["color_holds"]); !holds.empty())
    request.color_holds = parse_color_holds(holds, "color_holds");
  request.ambient = py::cast<std::optional<std::array<double, 3>>>(words["ambient"]);
  check_reach("radius", request.radius);
  check_reach("length", request.length);
  return request;
}

SharedFrame held_reference(Reference&& traced, const std::string& scene, const std::string& checkpoint) {
  auto held = std::make_shared<HeldFrame>(HeldFrame{std::move(traced.frame), scene});
  held->frame.numbers["seconds"] = traced.seconds;
  add_new(held->frame.assumed, traced.notes);
  if (traced.unlike_share > 0.01)
    held->frame.assumed.push_back(
        fmt::format("in {:.1f} % of the pixels looked at the scene is over 1 % nearer or farther than the frame",
                    100 * traced.unlike_share));
  std::error_code gone;
  if (!checkpoint.empty()) std::filesystem::remove(checkpoint, gone);
  return held;
}

SharedFrame reference_of(const HeldFrame& held, const py::object& given_scene, const py::dict& words) {
  const ReferenceJob job = job_of(request_from(words), as_keyword);
  ReferenceOptions options;
  const int seed = py::cast<int>(words["seed"]);
  check_seed(seed);
  options.seed = uint32_t(seed);
  const std::string checkpoint = py::cast<std::string>(words["checkpoint"]);
  options.checkpoint = checkpoint;
  const Settings settings = py::cast<Settings>(words["settings"]);
  const SharedScene scene = given_scene.is_none() ? scene_of(held, settings) : py::cast<SharedScene>(given_scene);
  return without_lock([&](Interrupts& interrupts) {
    options.poll = [&interrupts] { interrupts.poll(); };
    if (job.has_radius)
      options.radius = radius_of_truth(job.radius, stated_radius(held.frame), scene->scene(), held.frame).value;
    Reference traced = job.trace(scene->tracer(), held.frame, options);
    return held_reference(std::move(traced), scene->scene().name, checkpoint);
  });
}

py::dict facts_of(const SceneRecipe& recipe) {
  py::dict facts;
  facts["name"] = recipe.name;
  facts["summary"] = recipe.summary;
  return facts;
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<HeldScene, SharedScene>(module, "HeldScene")
      .def(py::init(&load))
      .def_property_readonly("name", [](const HeldScene& self) { return text_of(self.scene().name); })
      .def_property_readonly("faces", [](const HeldScene& self) { return self.scene().faces(); })
      .def_property_readonly("cameras",
                             [](const HeldScene& self) {
                               std::vector<std::string> names;
                               for (const SceneCamera& camera : self.scene().cameras) names.push_back(camera.name);
                               return texts_of(names);
                             })
      .def_property_readonly("ao_radius", [](const HeldScene& self) { return self.scene().ao_radius; })
      .def_property_readonly("notes", [](const HeldScene& self) { return texts_of(self.scene().notes); });
  module.def("scenes", [] {
    py::list list;
    for (const SceneRecipe& recipe : builtin_scenes()) list.append(facts_of(recipe));
    return list;
  });
  module.def("capture", &capture_scene);
  module.def("reference", &reference_of);
}

}  // namespace gloam::python
