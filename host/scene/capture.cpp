#include "gloam/scene/capture.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <mutex>

#include "base/elapsed.h"
#include "base/lists.h"
#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/projection.h"
#include "shared/sampling/stochastic.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr const char* second_view_name = "view2";
constexpr float infinity = std::numeric_limits<float>::infinity();

/// The depth at which a view's frustum ends, where the camera has one.
double far_of(const Camera& camera) { return camera.far.value_or(std::numeric_limits<double>::infinity()); }

/// The planes of one view, found once instead of by name for every pixel.
struct Target {
  Channel* depth = nullptr;
  Channel *normal[3] = {}, *albedo[3] = {}, *color[3] = {}, *reflectance[3] = {}, *position[3] = {}, *motion[2] = {};
  Channel *roughness = nullptr, *back_depth = nullptr, *instance = nullptr, *peel_count = nullptr,
          *outline_count = nullptr;
  std::vector<Channel*> peel, stochastic;
};

Plane empty_plane(const std::string& name, const Layout& layout) {
  const PlaneKind kind = plane_kind(name);
  Plane plane{name, {}};
  for (size_t i = 0; i < kind.components.size(); ++i) plane.channels.emplace_back(layout, kind.outside);
  return plane;
}

Channel* add_channel(View& view, const std::string& name, const Layout& layout) {
  Plane& plane = view.planes.emplace(name, empty_plane(name, layout)).first->second;
  return &plane.channels.front();
}

Target make_target(View& view, const CaptureOptions& options, const Layout& layout) {
  Target target;
  const auto single = [&](const char* name, Channel*& channel) {
    if (contains(options.planes, std::string(name))) channel = add_channel(view, name, layout);
  };
  const auto several = [&](const char* name, auto& channels) {
    if (!contains(options.planes, std::string(name))) return;
    Channel* first = add_channel(view, name, layout);
    for (size_t i = 0; i < std::size(channels); ++i) channels[i] = first + i;
  };
  target.depth = add_channel(view, "depth", layout);
  several("normal", target.normal);
  several("albedo", target.albedo);
  several("color", target.color);
  several("reflectance", target.reflectance);
  several("position", target.position);
  several("motion", target.motion);
  single("roughness", target.roughness);
  single("back_depth", target.back_depth);
  single("instance", target.instance);
  if (options.peel > 0) target.peel_count = add_channel(view, "peel_count", layout);
  if (options.outlines) target.outline_count = add_channel(view, "outline_count", layout);
  for (int i = 0; i < options.peel; ++i) target.peel.push_back(add_channel(view, layer_name("peel", i), layout));
  for (int i = 0; i < options.stochastic.samples; ++i)
    target.stochastic.push_back(add_channel(view, layer_name("stochastic", i), layout));
  return target;
}

template <size_t n, typename Vector>
void put(Channel* const (&channels)[n], int x, int y, const Vector& value) {
  if (!channels[0]) return;
  for (size_t i = 0; i < n; ++i) channels[i]->at(x, y) = float(value[int(i)]);
}

/// Whether the image shows anything at a pixel: light of a display's module may miss the screen there.
bool shows(const Camera& camera, int x, int y) {
  return !camera.slits || view_ray(camera, {x + 0.5, y + 0.5}).has_value();
}

/// Pixels that are not background.
long long surfaces_in(const Channel& depth) {
  long long count = 0;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x) count += !is_background(depth.at(x, y));
  return count;
}

/// Depths of all surfaces under the pixels of a row.
struct RowDepths {
  std::vector<float> depths;  ///< of each pixel front to back, one pixel after another
  std::vector<size_t> ends;   ///< of each pixel's, in `depths`
};

/// Makes one view's stochastic depth map: the same bits as kernels/stochastic_depth from the same surfaces.
class StochasticMap {
 public:
  StochasticMap(const StochasticOptions& options, const std::vector<Channel*>& samples)
      : alpha_(uint32_t(float(options.alpha) * float(STOCHASTIC_ONE))),
        seed_(uint32_t(options.seed)),
        samples_(samples) {}

  bool is_wanted() const { return !samples_.empty(); }

  void row(int y, const RowDepths& row) const {
    size_t begin = 0;
    for (size_t x = 0; x < row.ends.size(); ++x) {
      pixel(int(x), y, row.depths.data() + begin, row.depths.data() + row.ends[x]);
      begin = row.ends[x];
    }
  }

 private:
  /// Front to back, so that a sample keeps the first that it is offered.
  void pixel(int x, int y, const float* begin, const float* end) const {
    uint32_t empty = (1u << samples_.size()) - 1;
    for (const float* depth = begin; depth < end && empty != 0; ++depth) {
      const uint32_t hash = surface_hash(uint32_t(x), uint32_t(y), seed_, std::bit_cast<uint32_t>(*depth),
                                         std::bit_cast<uint32_t>(*begin));
      const uint32_t subset = stratified_subset(hash, alpha_) & empty;
      for (uint32_t left = subset; left != 0; left &= left - 1)
        samples_[size_t(std::countr_zero(left))]->at(x, y) = *depth;
      empty &= ~subset;
    }
  }

  uint32_t alpha_, seed_;
  const std::vector<Channel*>& samples_;
};

/// Counts the outlines that one view's rays are in where they meet what is visible.
class OutlineCounter {
 public:
  OutlineCounter(const Outlines* outlines, const Camera& camera, const Target& target)
      : outlines_(outlines), camera_(camera), target_(target) {
    if (!outlines_ || camera.orthographic || camera.slits) return;
    at_eye_ = outlines_->around(camera.pose->position - outlines_->scene().origin);
  }

  /// Once the row has its depths.
  void row(int y) const {
    if (!outlines_) return;
    for (int x = 0; x < target_.depth->layout().width; ++x) {
      if (!shows(camera_, x, y)) continue;
      // From the eye on, whatever the near plane hides: an outline that begins before it is one to be in.
      TracerRay ray = camera_ray(camera_, outlines_->scene().origin, x + 0.5, y + 0.5);
      const float depth = target_.depth->at(x, y);
      ray.far = is_background(depth) ? far_of(camera_) : double(depth);
      // Orthographic rays start at places of their own; behind most of them there is nothing.
      const int at_start = at_eye_ ? *at_eye_ : outlines_->around(ray.origin, -ray.direction);
      target_.outline_count->at(x, y) = float(at_start + outlines_->crossings(ray));
    }
  }

 private:
  const Outlines* outlines_;
  const Camera& camera_;
  const Target& target_;
  std::optional<int> at_eye_;
};

/// What a part of the work took.
struct PartSeconds {
  double stochastic = 0, outlines = 0;
};

/// Captures the rows of one view.
class Capturer {
 public:
  Capturer(const Tracer& tracer, const CaptureView& view, const Target& target, const CaptureOptions& options)
      : tracer_(tracer),
        view_(view),
        target_(target),
        stochastic_(options.stochastic, target.stochastic),
        outlines_(options.outlines, view.camera, target) {
    needs_all_ = target.back_depth || target.peel_count || stochastic_.is_wanted();
  }

  PartSeconds row(int y, int width) const {
    std::vector<Surface> surfaces;
    RowDepths depths;
    for (int x = 0; x < width; ++x) {
      pixel(x, y, uint32_t(y * width + x), surfaces);
      if (!stochastic_.is_wanted()) continue;
      for (const Surface& surface : surfaces) depths.depths.push_back(float(surface.distance));
      depths.ends.push_back(depths.depths.size());
    }
    PartSeconds seconds;
    auto start = std::chrono::steady_clock::now();
    stochastic_.row(y, depths);
    seconds.stochastic = seconds_since(start);
    start = std::chrono::steady_clock::now();
    outlines_.row(y);
    seconds.outlines = seconds_since(start);
    return seconds;
  }

 private:
  void pixel(int x, int y, uint32_t seed, std::vector<Surface>& surfaces) const {
    surfaces.clear();
    if (!shows(view_.camera, x, y)) return;
    TracerRay ray = camera_ray(view_.camera, tracer_.scene().origin, x + 0.5, y + 0.5);
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
    layers(x, y, surfaces);
    if (target_.instance) target_.instance->at(x, y) = float(first.mesh + 1);
    const dvec3 world = first.position + tracer_.scene().origin;
    put(target_.position, x, y, world - view_.camera.pose->position);
    moved(x, y, world, 1);
  }

  void background(int x, int y, const TracerRay& ray) const {
    put(target_.color, x, y, sky_radiance(tracer_.scene(), ray.direction));
    moved(x, y, ray.direction, 0);
  }

  void material(int x, int y, const Surface& surface, uint32_t seed) const {
    if (!target_.albedo[0] && !target_.color[0] && !target_.roughness && !target_.reflectance[0]) return;
    const SurfaceMaterial material = tracer_.material(surface);
    put(target_.albedo, x, y, material.albedo);
    put(target_.reflectance, x, y, material.reflectance);
    if (target_.roughness) target_.roughness->at(x, y) = material.roughness;
    if (target_.color[0]) put(target_.color, x, y, radiance(tracer_, surface, seed));
  }

  void layers(int x, int y, const std::vector<Surface>& surfaces) const {
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

  void moved(int x, int y, const dvec3& world, double w) const {
    if (!target_.motion[0] || !view_.previous_camera) return;
    const std::optional<glm::dvec2> before = place_in_world(*view_.previous_camera, world, w);
    if (before) put(target_.motion, x, y, *before - glm::dvec2(x + 0.5, y + 0.5));
  }

  const Tracer& tracer_;
  const CaptureView& view_;
  const Target& target_;
  StochasticMap stochastic_;
  OutlineCounter outlines_;
  bool needs_all_;
};

void check_stochastic(const StochasticOptions& options) {
  if (options.samples < 0 || options.samples > STOCHASTIC_MOST)
    throw UsageError("a stochastic depth map of {} samples cannot be made; 1 to {} can", options.samples,
                     STOCHASTIC_MOST);
  if (!(options.alpha >= 0 && options.alpha <= 1))
    throw UsageError("alpha {:g} is no share of the samples; give 0 to 1", options.alpha);
  if (options.seed < 0) throw UsageError("seed {} is negative; give 0 or more", options.seed);
}

/// `what` makes two views of the only one.
void check_can_become_two(const CaptureOptions& options, const char* what, const char* how) {
  if (options.second_view && options.stereo)
    throw UsageError("a second view and a pair of eyes cannot be had together; leave out one of them");
  if (options.views.size() != 1) throw UsageError("{} {} one view, and there are {}", what, how, options.views.size());
  if (contains(options.planes, "motion")) throw UsageError("{} has no motion; leave out one of them", what);
}

void check_second_view(const CaptureOptions& options) {
  const double degrees = *options.second_view;
  if (!(std::abs(degrees) <= 90) || degrees == 0)
    throw UsageError("a second view turned by {:g} degrees cannot be had; -90 to 90 can, but not 0", degrees);
  check_can_become_two(options, "a second view", "goes beside");
  if (options.views[0].name == second_view_name)
    throw UsageError("the first view is called '{}', as the second would be; give it another name", second_view_name);
}

void check_options(const CaptureOptions& options) {
  if (options.width < 1 || options.height < 1)
    throw UsageError("a capture of {}x{} pixels has none; give a size such as 1920x1080", options.width,
                     options.height);
  if (options.peel < 0 || options.peel > 64) throw UsageError("{} layers cannot be peeled; 0 to 64 can", options.peel);
  for (const std::string& plane : options.planes) {
    if (contains(capture_planes(), plane)) continue;
    throw UsageError("plane '{}' cannot be captured{}; {} can, and layers by their number", plane,
                     suggestion(plane, capture_planes()), enumerate(capture_planes()));
  }
  check_stochastic(options.stochastic);
  if (options.second_view) check_second_view(options);
  if (options.stereo) check_can_become_two(options, "a pair of eyes", "takes the place of");
  for (const CaptureView& view : options.views) {
    if (!view.camera.pose) throw Error("view '{}' has a camera without a pose; give its camera_to_world", view.name);
  }
}

int thread_count() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

/// All rows of a view, on all threads. Returns the seconds of its parts as a mean over the threads.
PartSeconds capture_rows(const Capturer& capturer, const CaptureOptions& options, int rows_before) {
  const int rows = options.height * int(options.views.size() + (options.second_view ? 1 : 0));
  int done = rows_before;
  PartSeconds sum;
  std::atomic<bool> failed = false;
  std::mutex mutex;
  std::exception_ptr failure;  // an exception may not leave a parallel loop
#pragma omp parallel for schedule(dynamic, 4)
  for (int y = 0; y < options.height; ++y) {
    try {
      if (failed) continue;
      const PartSeconds seconds = capturer.row(y, options.width);
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
  const int rows_before = options.height * int(result.frame.views.size());
  View& view = result.frame.views.emplace_back();
  view.name = from.name;
  view.camera = from.camera;
  view.origin = from.camera.pose->position;
  const Target target = make_target(view, options, Layout(options.width, options.height));
  const PartSeconds seconds = capture_rows(Capturer(tracer, from, target, options), options, rows_before);
  result.stochastic_seconds += seconds.stochastic;
  result.outline_seconds += seconds.outlines;
  const bool lit = target.color[0] && tracer.scene().light.sun != vec3(0);
  const long long surfaces = surfaces_in(*target.depth);
  result.surfaces += surfaces;
  result.rays += (options.outlines ? 2LL : 1LL) * options.width * options.height + (lit ? most_sun_rays * surfaces : 0);
}

/// From what the first view shows.
CaptureView second_view(const CaptureOptions& options, CaptureResult& result) {
  result.visible = visible_depths(result.frame.views[0].planes.at("depth").channels[0]);
  if (!result.visible)
    throw Error("the first view shows nothing that a second could turn about; another camera may see it");
  return {second_view_name, secondary_camera(options.views[0].camera, options.width, options.height, *result.visible,
                                             *options.second_view)};
}

/// With the eyes in place of the camera that is the middle between them.
CaptureOptions with_both_eyes(CaptureOptions options) {
  if (!options.stereo) return options;
  const auto [left, right] = stereo_cameras(options.views[0].camera, *options.stereo);
  options.views = {{"left", left, {}}, {"right", right, {}}};
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
  if (options.method == OutlineMethod::integrated) frame.numbers["gloamOutlineAngle"] = options.angle_degrees;
}

}  // namespace

const std::vector<std::string>& capture_planes() {
  static const std::vector<std::string> planes = {"depth",       "normal",   "albedo",     "color",    "roughness",
                                                  "reflectance", "position", "back_depth", "instance", "motion"};
  return planes;
}

TracerRay camera_ray(const Camera& camera, const dvec3& scene_origin, double x, double y) {
  const std::optional<ViewRay> seen = view_ray(camera, {x, y});
  if (!seen) throw Error("nothing is shown at ({:g}, {:g}): the module's light misses the screen", x, y);
  const glm::dmat3 to_world = glm::transpose(camera.pose->world_to_view);
  const dvec3 eye = camera.pose->position - scene_origin;
  TracerRay ray;
  ray.origin = eye + to_world * seen->start;
  ray.direction = to_world * seen->per_depth;
  return ray;
}

vec3 sky_radiance(const Scene& scene, const dvec3& direction) {
  const Light& light = scene.light;
  const float height = float(glm::dot(glm::normalize(direction), glm::normalize(scene.up)));
  if (height < 0) return glm::mix(light.horizon, light.ground, std::min(-4 * height, 1.0f));
  return glm::mix(light.horizon, light.zenith, std::sqrt(height));
}

vec3 radiance(const Tracer& tracer, const Surface& surface, uint32_t seed, int sun_rays) {
  const Scene& scene = tracer.scene();
  const Light& light = scene.light;
  const SurfaceMaterial material = tracer.material(surface);
  const vec3 diffuse = material.albedo * (1 - material.metallic);
  // The sky as a blend of its zenith and the ground, by how far the surface faces up.
  const float facing_up = 0.5f + 0.5f * float(glm::dot(surface.normal, glm::normalize(scene.up)));
  vec3 irradiance = glm::pi<float>() * glm::mix(light.ground, 0.5f * (light.zenith + light.horizon), facing_up);
  const dvec3 to_sun = glm::normalize(dvec3(light.to_sun));
  if (light.sun != vec3(0) && glm::dot(to_sun, surface.normal) > -0.1) {
    vec3 directions[most_sun_rays];
    bool blocked[most_sun_rays];
    const glm::dmat3 about = frame_about(to_sun);
    const double disc = std::tan(light.sun_angle_degrees * glm::pi<double>() / 180);
    for (int i = 0; i < sun_rays; ++i) {
      const glm::dvec2 u = scrambled_sobol(uint32_t(i), hash(seed));
      const double radius = disc * std::sqrt(u.x), angle = glm::two_pi<double>() * u.y;
      directions[i] = vec3(glm::normalize(about * dvec3(radius * std::cos(angle), radius * std::sin(angle), 1.0)));
    }
    tracer.blocked(tracer.lifted(surface), directions, sun_rays, infinity, blocked);
    float cosines = 0;
    for (int i = 0; i < sun_rays; ++i) {
      const vec3& d = directions[i];
      if (blocked[i] || glm::dot(d, vec3(surface.facing)) <= 0) continue;
      cosines += std::max(glm::dot(d, vec3(surface.normal)), 0.0f);
    }
    irradiance += light.sun * (cosines / float(sun_rays));
  }
  return material.emission + diffuse * irradiance / glm::pi<float>();
}

CaptureResult capture(const Tracer& tracer, const CaptureOptions& asked) {
  check_options(asked);
  const CaptureOptions options = with_both_eyes(asked);
  const auto start = std::chrono::steady_clock::now();
  CaptureResult result;
  Frame& frame = result.frame;
  frame.display = frame.window = {0, 0, options.width, options.height};
  frame.attributes["gloamScene"] = tracer.scene().name;
  for (const CaptureView& view : options.views) capture_view(tracer, view, options, result);
  if (options.second_view) {
    if (frame.views[0].name.empty()) frame.views[0].name = "main";
    capture_view(tracer, second_view(options, result), options, result);
    frame.numbers["gloamSecondView"] = *options.second_view;
  }
  if (options.stereo) say_stereo(frame, *options.stereo);
  if (options.outlines) say_outlines(frame, options.outlines->options());
  if (options.stochastic.samples > 0) {
    frame.numbers["gloamStochasticAlpha"] = options.stochastic.alpha;
    frame.attributes["gloamStochasticSeed"] = std::to_string(options.stochastic.seed);
  }
  result.seconds = seconds_since(start);
  return result;
}

}  // namespace gloam
