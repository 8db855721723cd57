#include "gloam/scene/capture.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <mutex>
#include <optional>
#include <utility>

#include "base/elapsed.h"
#include "base/lists.h"
#include "gloam/color_holds.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/planes.h"
#include "gloam/projection.h"
#include "gloam/radius.h"
#include "gloam/scene/camera_ray.h"
#include "gloam/scene/radiance.h"
#include "gloam/scene/tracer.h"
#include "scene/capture_options.h"
#include "scene/capture_target.h"
#include "scene/earlier_scene.h"
#include "scene/stochastic_map.h"

namespace gloam {
namespace {

/// Counts the outlines that contain the visible surfaces of one view.
class OutlineCounter {
 public:
  OutlineCounter(const Outlines* outlines, const Camera& camera, const Window& window, const CaptureTarget& target);

  /// Counts for a row whose depths are filled.
  void row(int y) const;

 private:
  const Outlines* outlines_;
  const Camera& camera_;
  Window window_;
  const CaptureTarget& target_;
  std::optional<int> at_eye_;
};

OutlineCounter::OutlineCounter(const Outlines* outlines, const Camera& camera, const Window& window,
                               const CaptureTarget& target)
    : outlines_(outlines), camera_(camera), window_(window), target_(target) {
  if (!outlines_ || camera.orthographic || camera.slits) return;
  at_eye_ = outlines_->around(camera.pose->position - outlines_->scene().origin);
}

void OutlineCounter::row(int y) const {
  if (!outlines_) return;
  for (int x = 0; x < target_.depth->layout().width; ++x) {
    const int px = x + window_.x0, py = y + window_.y0;
    if (!shows(camera_, px, py)) continue;
    // From the eye on, whatever the near plane hides: an outline before that plane contains the eye too.
    TracerRay ray = camera_ray(camera_, outlines_->scene().origin, px + 0.5, py + 0.5);
    const float depth = target_.depth->at(x, y);
    ray.far = is_background(depth) ? far_of(camera_) : double(depth);
    // Each orthographic ray has its own start; most starts have nothing behind them.
    const int at_start = at_eye_ ? *at_eye_ : outlines_->around(ray.origin, -ray.direction);
    target_.outline_count->at(x, y) = float(at_start + outlines_->crossings(ray));
  }
}

using glm::dvec3;
using glm::vec3;

/// Pixels that are not background.
long long surfaces_in(const Channel& depth) {
  long long count = 0;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x) count += !is_background(depth.at(x, y));
  return count;
}

/// Seconds of parts of the work.
struct PartSeconds {
  double stochastic = 0, outlines = 0;
};

/// Whether two cameras project every point to the same place.
bool is_same(const Camera& a, const Camera& b) {
  return a.orthographic == b.orthographic && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && !a.slits &&
         !b.slits && a.pose && b.pose && a.pose->position == b.pose->position &&
         a.pose->world_to_view == b.pose->world_to_view;
}

/// The pixels of a capture, in which the picture begins at (0, 0).
Window window_of(const CaptureOptions& options) {
  return {-options.margin_x, -options.margin_y, options.width + options.margin_x, options.height + options.margin_y};
}

/// Captures the rows of one view. Pixels (x, y) of the planes are (x + window.x0, y + window.y0) of the picture.
class Capturer {
 public:
  Capturer(const Tracer& tracer, const CaptureView& view, const CaptureTarget& target, const CaptureOptions& options)
      : tracer_(tracer),
        view_(view),
        target_(target),
        before_(options.previous_scene),
        window_(window_of(options)),
        width_(options.width),
        stochastic_(options.stochastic, window_, target.stochastic),
        outlines_(options.outlines, view.camera, window_, target) {
    stands_still_ = view.previous_camera && is_same(view.camera, *view.previous_camera);
    needs_all_ = target.back_depth || target.peel_count || stochastic_.is_wanted();
  }

  PartSeconds row(int y) {
    std::vector<Surface> surfaces;
    RowDepths depths;
    for (int x = 0; x < window_.width(); ++x) {
      pixel(x, y, surfaces);
      if (!stochastic_.is_wanted()) continue;
      for (const Surface& surface : surfaces) depths.depths.push_back(float(surface.distance));
      depths.ends.push_back(depths.depths.size());
    }
    PartSeconds seconds;
    auto start = std::chrono::steady_clock::now();
    stochastic_.row(y, std::move(depths));
    seconds.stochastic = seconds_since(start);
    start = std::chrono::steady_clock::now();
    outlines_.row(y);
    seconds.outlines = seconds_since(start);
    return seconds;
  }

  /// What needs all rows. Returns the seconds.
  double complete() {
    const auto start = std::chrono::steady_clock::now();
    stochastic_.choose_among_kept(*target_.depth, view_.camera);
    return seconds_since(start);
  }

 private:
  void pixel(int x, int y, std::vector<Surface>& surfaces) const {
    surfaces.clear();
    const int px = x + window_.x0, py = y + window_.y0;
    if (!shows(view_.camera, px, py)) return;
    const auto seed = uint32_t(py * width_ + px);  // the same with any margin
    TracerRay ray = camera_ray(view_.camera, tracer_.scene().origin, px + 0.5, py + 0.5);
    ray.near = view_.camera.near.value_or(0);
    ray.far = far_of(view_.camera);
    if (needs_all_) {
      tracer_.all(ray, surfaces);
    } else if (const std::optional<Surface> first = tracer_.first(ray)) {
      surfaces.push_back(*first);
    }
    if (surfaces.empty()) {
      background(x, y, ray);
      return;
    }
    const Surface& first = surfaces.front();
    target_.depth->at(x, y) = float(first.distance);
    put(target_.normal, x, y, glm::normalize(view_.camera.pose->world_to_view * first.normal));
    material(x, y, first, seed);
    layers(x, y, surfaces, seed);
    if (target_.instance) target_.instance->at(x, y) = float(first.mesh + 1);
    const dvec3 world = first.position + tracer_.scene().origin;
    put(target_.position, x, y, world - view_.camera.pose->position);
    moved(x, y, world, before_ ? earlier_position(tracer_.scene(), *before_, first) : world, 1);
  }

  void background(int x, int y, const TracerRay& ray) const {
    put(target_.color, x, y, sky_radiance(tracer_.scene(), ray.direction));
    moved(x, y, ray.direction, ray.direction, 0);
  }

  void material(int x, int y, const Surface& surface, uint32_t seed) const {
    if (!target_.has_material) return;
    const SurfaceMaterial material = tracer_.material(surface);
    put(target_.albedo, x, y, material.albedo);
    put(target_.reflectance, x, y, material.reflectance);
    if (target_.roughness) target_.roughness->at(x, y) = material.roughness;
    if (target_.metallic) target_.metallic->at(x, y) = material.metallic;
    put(target_.emission, x, y, material.emission);
    if (!target_.color[0] && !target_.ambient[0]) return;
    const Radiance light = radiance(tracer_, surface, seed);
    put(target_.color, x, y, light.all);
    put(target_.ambient, x, y, light.ambient);
  }

  /// Light and normals of all surfaces. Of a hidden back face the other side: the outside of what it closes.
  void peel_light(int x, int y, const std::vector<Surface>& surfaces, uint32_t seed) const {
    for (size_t i = 0; i < std::min(target_.peel_color.size(), surfaces.size()); ++i) {
      Surface surface = surfaces[i];
      if (i > 0 && surface.back_face) {
        surface.normal = -surface.normal;
        surface.facing = -surface.facing;
      }
      put(target_.peel_color[i], x, y, radiance(tracer_, surface, seed).all);
      put(target_.peel_normal[i], x, y, glm::normalize(view_.camera.pose->world_to_view * surface.normal));
    }
  }

  void layers(int x, int y, const std::vector<Surface>& surfaces, uint32_t seed) const {
    peel_light(x, y, surfaces, seed);
    if (target_.peel_count) target_.peel_count->at(x, y) = float(surfaces.size());
    for (size_t i = 0; i < std::min(target_.peel.size(), surfaces.size()); ++i)
      target_.peel[i]->at(x, y) = float(surfaces[i].distance);
    if (!target_.back_depth) return;
    for (size_t i = 1; i < surfaces.size(); ++i) {
      if (surfaces[i].mesh != surfaces[0].mesh || !surfaces[i].back_face) continue;
      target_.back_depth->at(x, y) = float(surfaces[i].distance);
      return;
    }
  }

  /// `now`: what the pixel shows; `earlier`: where the frame before has it.
  void moved(int x, int y, const dvec3& now, const dvec3& earlier, double w) const {
    if (!target_.motion[0] || !view_.previous_camera) return;
    if (stands_still_ && earlier == now)
      return put(target_.motion, x, y, glm::dvec2(0));  // without the rounding of a projection
    const std::optional<glm::dvec2> before = pixel_of_world(*view_.previous_camera, earlier, w);
    if (before) put(target_.motion, x, y, *before - glm::dvec2(x + window_.x0 + 0.5, y + window_.y0 + 0.5));
  }

  const Tracer& tracer_;
  const CaptureView& view_;
  const CaptureTarget& target_;
  const Scene* before_;
  Window window_;
  int width_;  ///< of the picture
  StochasticMap stochastic_;
  OutlineCounter outlines_;
  bool needs_all_, stands_still_;
};

int thread_count() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

/// Captures all rows of a view on all threads. Returns the seconds of the parts as a mean over the threads.
PartSeconds capture_rows(Capturer& capturer, const CaptureOptions& options, int rows_before) {
  const int height = window_of(options).height();
  const int rows = height * int(options.views.size() + (options.second_view ? 1 : 0));
  int done = rows_before;
  PartSeconds sum;
  std::atomic<bool> failed = false;
  std::mutex mutex;
  std::exception_ptr failure;  // an exception may not leave a parallel loop
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < height; ++y) {
    try {
      if (failed) continue;
      const PartSeconds seconds = capturer.row(y);
      const std::lock_guard<std::mutex> lock(mutex);
      sum.stochastic += seconds.stochastic;
      sum.outlines += seconds.outlines;
      ++done;
      if (options.progress) options.progress(done, rows);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      failed = true;
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  return {sum.stochastic / thread_count(), sum.outlines / thread_count()};
}

/// Adds a view to the frame.
void capture_view(const Tracer& tracer, const CaptureView& from, const CaptureOptions& options, CaptureResult& result) {
  const Window window = window_of(options);
  const int rows_before = window.height() * int(result.frame.views.size());
  View& view = result.frame.views.emplace_back();
  view.name = from.name;
  view.camera = from.camera;
  view.origin = from.camera.pose->position;
  const Light& light = tracer.scene().light;
  if (light.sun != vec3(0) && light.to_sun != vec3(0)) view.light = glm::normalize(dvec3(light.to_sun));
  const CaptureTarget target = capture_target(view, options, Layout(window.width(), window.height()));
  Capturer capturer(tracer, from, target, options);
  const PartSeconds seconds = capture_rows(capturer, options, rows_before);
  result.stochastic_seconds += seconds.stochastic + capturer.complete();
  result.outline_seconds += seconds.outlines;
  const bool lit = target.color[0] && tracer.scene().light.sun != vec3(0);
  const long long surfaces = surfaces_in(*target.depth);
  result.surfaces += surfaces;
  result.rays +=
      (options.outlines ? 2LL : 1LL) * window.width() * window.height() + (lit ? most_sun_rays * surfaces : 0);
}

/// The second view, from the depths that the first shows.
CaptureView second_view(const CaptureOptions& options, CaptureResult& result) {
  const Frame& frame = result.frame;
  result.visible = visible_depths(part_of(frame.views[0].planes.at("depth").channels[0], frame.window, frame.display));
  if (!result.visible)
    throw Error("the first view shows nothing that a second could turn about; another camera may see it");
  return {second_view_name, secondary_camera(options.views[0].camera, options.width, options.height, *result.visible,
                                             *options.second_view)};
}

/// Options with both eyes instead of the camera in the middle between them.
CaptureOptions with_both_eyes(CaptureOptions options) {
  if (!options.stereo) return options;
  const auto [left, right] = stereo_cameras(options.views[0].camera, *options.stereo);
  const std::optional<Camera> middle_before = options.views[0].previous_camera;
  options.views = {{"left", left, {}}, {"right", right, {}}};
  if (!middle_before) return options;
  const std::array<Camera, 2> before = stereo_cameras(*middle_before, *options.stereo);
  for (size_t eye : {0, 1}) options.views[eye].previous_camera = before[eye];
  return options;
}

void say_stereo(Frame& frame, const StereoRig& rig) {
  frame.numbers["gloamStereo"] = rig.interpupillary_distance;
  if (rig.convergence) frame.numbers["gloamConvergence"] = *rig.convergence;
  if (rig.toe_in) frame.numbers["gloamToeIn"] = toe_in_degrees(rig);
}

void say_outlines(Frame& frame, const OutlineOptions& options) {
  frame.numbers["gloamOutlines"] = options.extent;
  frame.attributes["gloamOutlineMethod"] = outline_methods()[size_t(options.method)];
  if (has_angle(options.method)) frame.numbers["gloamOutlineAngle"] = options.angle_degrees;
}

}  // namespace

const std::vector<std::string>& capture_planes() {
  static const std::vector<std::string> planes = {"depth",       "normal",   "albedo",     "color",    "roughness",
                                                  "reflectance", "position", "back_depth", "instance", "motion",
                                                  "ambient",     "metallic", "emission"};
  return planes;
}

std::vector<std::string> usual_capture_planes() {
  std::vector<std::string> planes = capture_planes();
  for (const char* special : {"motion", "ambient", "metallic", "emission"}) std::erase(planes, special);
  return planes;
}

std::optional<double> suitable_radius(const Tracer& tracer, const CaptureOptions& options) {
  if (tracer.scene().ao_radius > 0) return tracer.scene().ao_radius;
  CaptureOptions depth = options;
  depth.planes.clear();
  depth.peel = depth.stochastic.samples = 0;
  depth.peel_light = false;
  depth.outlines = nullptr;
  depth.progress = {};
  return radius_made_from(capture(tracer, depth).frame);
}

CaptureResult capture(const Tracer& tracer, const CaptureOptions& asked) {
  check_options(asked);
  if (asked.previous_scene) check_earlier_scene(tracer.scene(), *asked.previous_scene);
  CaptureOptions options = with_both_eyes(asked);
  const auto start = std::chrono::steady_clock::now();
  // Where nothing is visible, nothing is relevant.
  if (is_of_relevant(options.stochastic) && !options.stochastic.radius)
    options.stochastic.radius = suitable_radius(tracer, asked).value_or(1);
  CaptureResult result;
  Frame& frame = result.frame;
  frame.display = {0, 0, options.width, options.height};
  frame.window = window_of(options);
  frame.attributes["gloamScene"] = tracer.scene().name;
  if (contains(options.planes, "color")) frame.attributes[color_holds_attribute] = in_words(ColorHolds());
  for (const CaptureView& view : options.views) capture_view(tracer, view, options, result);
  if (options.second_view) {
    if (frame.views[0].name.empty()) frame.views[0].name = "main";
    capture_view(tracer, second_view(options, result), options, result);
    frame.numbers["gloamSecondView"] = *options.second_view;
  }
  if (options.stereo) say_stereo(frame, *options.stereo);
  if (options.outlines) say_outlines(frame, options.outlines->options());
  if (options.stochastic.samples > 0) say_stochastic(frame, options.stochastic);
  result.seconds = seconds_since(start);
  return result;
}

}  // namespace gloam
