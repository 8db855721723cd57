#include "papers/study.h"

#include <algorithm>

#include "gloam/scene/capture.h"

namespace gloam::bench {
namespace {

Image of_first_view(const Stage& s, const Plane& plane) {
  Image image;
  image.emplace(s.frame.views[0].name, plane.clone());
  return image;
}

bool has_parameter(const Technique& technique, const std::string& name) {
  return std::any_of(technique.parameters.begin(), technique.parameters.end(),
                     [&](const Parameter& p) { return p.name == name; });
}

void take(Stage& s, CaptureResult result) {
  s.frame = std::move(result.frame);
  s.outline_seconds = result.outline_seconds;
  s.surfaces = foreground(s.frame);
}

}  // namespace

Asked with(Asked asked, const std::string& name, const std::string& value) {
  asked.settings.emplace_back(name, value);
  return asked;
}

double pixels_of(const Mask& mask) {
  return double(std::count_if(mask.begin(), mask.end(), [](auto m) { return m != 0; }));
}

Asked filtered(Asked asked) {
  asked.plane = "ao";
  return asked;
}

std::string size_of(const Stage& s) { return fmt::format("{}x{}", s.frame.width(), s.frame.height()); }

Stage Study::stage(const Shot& shot, int width, int height) const {
  Stage s;
  s.scene = load_scene(shot.scene, shot.settings);
  s.tracer = std::make_unique<Tracer>(s.scene);
  s.radius = s.scene.ao_radius;
  CaptureOptions capture{.width = width, .height = height, .planes = {"depth", "normal"}, .peel = shot.layers};
  if (shot.with_materials) {
    for (const char* plane : {"color", "roughness", "reflectance", "back_depth", "instance"})
      capture.planes.emplace_back(plane);
  }
  capture.views = {{"", camera_for(s.scene.cameras.at(size_t(shot.camera)), width, height), {}}};
  capture.second_view = shot.second_view;
  if (shot.eyes_apart) capture.stereo = StereoRig{.interpupillary_distance = *shot.eyes_apart};
  if (shot.with_outlines) s.outlines = std::make_unique<Outlines>(*s.tracer, OutlineOptions{.extent = s.radius});
  capture.outlines = s.outlines.get();
  take(s, gloam::capture(*s.tracer, capture));
  return s;
}

void Study::look_from(Stage& s, const SceneCamera& camera) const {
  const int width = s.frame.width(), height = s.frame.height();
  CaptureOptions capture{.width = width, .height = height, .planes = {"depth", "normal"}, .outlines = s.outlines.get()};
  capture.views = {{"", camera_for(camera, width, height), {}}};
  take(s, gloam::capture(*s.tracer, capture));
}

Stage Study::small_stage(const Shot& shot, int divisor) const {
  return stage(shot, std::max(options_.width / divisor, 16), std::max(options_.height / divisor, 9));
}

Plan Study::plan_of(const Stage& s, const Asked& asked) const {
  PlanRequest request{
      .outputs = {asked.technique}, .only_outputs = {asked.plane}, .only = asked.mask, .resolution = asked.resolution};
  if (asked.plane == "ao_raw") request.filter = "none";
  request.settings = asked.settings;
  const bool has_radius = asked.plane == "ao" || has_parameter(find_technique(asked.technique), "radius");
  if (has_radius) request.settings.emplace_back("radius", std::to_string(s.radius));
  return make_plan(request, planes_of(s.frame), "the captured frame");
}

Plane Study::image(const Stage& s, const Asked& asked) const {
  return std::move(run(plan_of(s, asked), s.frame, device_).frame.views[0].planes.at(asked.plane));
}

Image Study::images(const Stage& s, const Asked& asked) const {
  return image_of(run(plan_of(s, asked), s.frame, device_).frame, asked.plane);
}

Image Study::traced(const Stage& s, AoReferenceOptions rays) const {
  rays.radius = s.radius;
  return image_of(ao_reference(*s.tracer, s.frame, rays).frame, "ao");
}

Plane Study::truth(const Stage& s, const Technique* like) const {
  AoReferenceOptions rays{.samples = options_.rays};
  if (like)
    rays.contribution = [like, defaults = ParameterValues(like->parameters)](double cosine, double distance) {
      return like->contribution(defaults, cosine, distance);
    };
  return std::move(traced(s, rays).at(s.frame.views[0].name));
}

double Study::error(const Stage& s, const Plane& test, const Plane& truth) const {
  return rmse(of_first_view(s, test), of_first_view(s, truth), s.surfaces);
}

double Study::mean_taken(const Stage& s, const Plane& ao) const {
  Plane open{ao.name, {}};
  open.channels.push_back(ao.channels[0].clone());
  for (int y = 0; y < s.frame.height(); ++y) std::fill_n(open.channels[0].row(y), s.frame.width(), 1.0f);
  return bias(of_first_view(s, open), of_first_view(s, ao), s.surfaces);
}

void Study::tell(const std::string& what, double share) const {
  if (options_.progress) options_.progress(what, share);
}

void Study::fact(const std::string& figure, const std::string& row, const std::string& column, double value,
                 const std::string& unit) {
  result.facts.push_back({figure, row, column, value, unit});
}

void Study::picture(const std::string& figure, const std::string& caption, const std::string& file,
                    const std::vector<Panel>& panels, int columns) {
  write_panels(options_.folder / file, panels, columns);
  result.pictures.push_back({figure, caption, file});
}

}  // namespace gloam::bench
