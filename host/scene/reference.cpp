#include "gloam/reference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <mutex>

#include "elapsed.h"
#include "fingerprint.h"
#include "gloam/capture.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/files.h"
#include "lists.h"
#include "low_discrepancy.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;
using Clock = std::chrono::steady_clock;

constexpr int packet = 16;

/// The attribute that makes a file a checkpoint.
constexpr const char* key_name = "gloamReferenceKey";

/// What an interrupted run says once something is kept.
constexpr const char* goes_on = "run it again and it goes on where it was";

/// Surfaces whose depth is this near to the frame's, as a share of it, are the frame's.
constexpr double same_depth = 0.01;

int rounded_samples(int samples) { return std::max(1, (samples + 2 * packet - 1) / (2 * packet)) * 2 * packet; }

// --- One pixel

/// Where a pixel's rays start, and the hemisphere that they fill.
struct Site {
  vec3 origin;
  vec3 facing;          ///< of the triangle: directions below it are closed
  glm::dmat3 to_world;  ///< columns: two tangents and the normal
};

/// What one half of the rays says.
class Estimator {
 public:
  Estimator(const Tracer& tracer, const AoReferenceOptions& options)
      : tracer_(tracer), options_(options), half_(rounded_samples(options.samples) / 2) {}

  /// Open share of the hemisphere, from `half_` rays of the set that `seed` names.
  double open_share(const Site& site, uint32_t seed) const {
    double closed = 0;
    for (int first = 0; first < half_; first += packet) closed += closed_by_packet(site, seed, first);
    return 1 - closed / half_;
  }

  int rays_per_pixel() const { return 2 * half_; }

 private:
  double closed_by_packet(const Site& site, uint32_t seed, int first) const {
    vec3 directions[packet];
    float cosines[packet];
    int count = 0;
    double closed = 0;
    for (int i = 0; i < packet; ++i) {
      const dvec3 local = cosine_direction(scrambled_sobol(uint32_t(first + i), seed));
      const vec3 direction(site.to_world * local);
      if (glm::dot(direction, site.facing) <= 0) {
        closed += taken(float(local.z), 0);  // the surface itself is in the way
        continue;
      }
      cosines[count] = float(local.z);
      directions[count++] = direction;
    }
    if (!options_.contribution) {
      bool blocked[packet];
      tracer_.blocked(site.origin, directions, count, float(options_.radius), blocked);
      return closed + double(std::count(blocked, blocked + count, true));
    }
    float distances[packet];
    tracer_.distances(site.origin, directions, count, float(options_.radius), distances);
    for (int i = 0; i < count; ++i) {
      if (std::isfinite(distances[i])) closed += taken(cosines[i], double(distances[i]) / options_.radius);
    }
    return closed;
  }

  double taken(double cosine, double distance) const {
    return options_.contribution ? options_.contribution(cosine, distance) : 1;
  }

  const Tracer& tracer_;
  const AoReferenceOptions& options_;
  int half_;
};

/// One view of the frame in front of its scene.
class ViewTracer {
 public:
  ViewTracer(const Tracer& tracer, const View& view, const Window& window)
      : tracer_(tracer), camera_(*view.camera), window_(window), depth_(view.planes.at("depth").channels[0]) {
    if (const Plane* normal = view.find("normal")) normal_ = &normal->channels;
    to_world_ = glm::transpose(camera_.pose->world_to_view);
  }

  bool is_background_at(int x, int y) const { return is_background(depth_.at(x, y)); }

  /// Where a foreground pixel's rays start. `alike`: whether the scene has a surface where the frame says.
  Site site(int x, int y, bool& alike) const {
    TracerRay ray = camera_ray(camera_, tracer_.scene().origin, window_.x0 + x + 0.5, window_.y0 + y + 0.5);
    ray.near = camera_.near.value_or(0);
    const double depth = depth_.at(x, y);
    std::optional<Surface> surface = surface_at(ray, depth, alike);
    Site site;
    dvec3 normal(0);
    if (normal_) normal = to_world_ * dvec3((*normal_)[0].at(x, y), (*normal_)[1].at(x, y), (*normal_)[2].at(x, y));
    if (surface) {
      site.origin = tracer_.lifted(*surface);
      site.facing = vec3(surface->facing);
      if (glm::length(normal) < 0.5) normal = surface->normal;
    } else {
      if (glm::length(normal) < 0.5) normal = -glm::normalize(ray.direction);
      site.origin = vec3(ray.origin + depth * (1 - 1e-4) * ray.direction);
      site.facing = vec3(normal);
    }
    site.to_world = frame_about(glm::normalize(normal));
    return site;
  }

 private:
  /// The first surface; where that is not the frame's, the one behind it that is.
  std::optional<Surface> surface_at(const TracerRay& ray, double depth, bool& alike) const {
    const auto fits = [depth](const Surface& s) { return std::abs(s.distance - depth) <= same_depth * depth; };
    const std::optional<Surface> first = tracer_.first(ray);
    alike = first && fits(*first);
    if (alike || !first) return first;
    std::vector<Surface> surfaces;
    tracer_.all(ray, surfaces);
    for (const Surface& surface : surfaces) {
      if (!fits(surface)) continue;
      alike = true;
      return surface;
    }
    return first;
  }

  const Tracer& tracer_;
  const Camera& camera_;
  Window window_;
  const Channel& depth_;
  const std::vector<Channel>* normal_ = nullptr;
  glm::dmat3 to_world_;
};

// --- What is kept between two runs

/// Tells one computation from another: all that the result depends on. The number is raised when the method changes.
std::string key_of(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options) {
  Fingerprint print;
  print.add(tracer.scene());
  print.add(frame);
  return fmt::format("2: {} {}x{} radius {} samples {} seed {} falloff {} {}", print.text(), frame.width(),
                     frame.height(), options.radius, rounded_samples(options.samples), options.seed, options.falloff,
                     options.falloff_parameters);
}

/// A file in the checkpoint's place that is not a checkpoint belongs to somebody.
void check_checkpoint(const std::filesystem::path& path) {
  std::error_code code;
  if (path.empty() || !std::filesystem::exists(std::filesystem::symlink_status(path, code))) return;
  bool ours = false;
  try {
    ours = std::filesystem::is_regular_file(path, code) && !FrameFile(path, {}).text_attribute(key_name).empty();
  } catch (const Error&) {
    // Not even an EXR.
  }
  if (!ours)
    throw Error("{}: is where an unfinished reference would be kept, and is something else; move it away",
                path.string());
}

/// Rows that an interrupted run has finished already: pixels that it has not are NaN.
void resume(AoReference& reference, const std::string& key, const AoReferenceOptions& options) {
  Frame& result = reference.frame;
  if (options.checkpoint.empty() || !std::filesystem::exists(options.checkpoint)) return;
  try {
    ReadOptions as_stored;
    as_stored.as_stored = true;
    FrameFile file(options.checkpoint, as_stored);
    if (file.text_attribute(key_name) != key) {
      reference.notes.push_back(fmt::format("{}: was the unfinished reference of other settings, and is given up",
                                            options.checkpoint.string()));
      return;
    }
    Frame kept = file.read({"ao", "ao_noise"});
    for (const char* name : {"ao", "ao_noise"}) {
      if (!contains(file.common_planes(), name)) return;
    }
    for (View& view : result.views) {
      for (const char* name : {"ao", "ao_noise"})
        view.planes.at(name) = std::move(kept.view(view.name).planes.at(name));
    }
  } catch (const Error&) {
    // Damaged: computed anew and written over.
  }
}

bool row_is_done(const Channel& ao, int y) { return !std::isnan(ao.at(0, y)); }

// --- All pixels

class AoTracing {
 public:
  AoTracing(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options)
      : tracer_(tracer), frame_(frame), options_(options), estimator_(tracer, options) {
    result_.frame.display = frame.display;
    result_.frame.window = frame.window;
    result_.frame.assumed = frame.assumed;
    const Layout layout(frame.width(), frame.height());
    for (const View& view : frame.views) {
      View& out = result_.frame.views.emplace_back();
      out.name = view.name;
      out.camera = view.camera;
      out.origin = view.origin;
      for (const char* name : {"ao", "ao_noise"}) {
        Plane& plane = out.planes[name];
        plane.name = name;
        plane.channels.emplace_back(layout, std::numeric_limits<float>::quiet_NaN());
      }
    }
    check_checkpoint(options.checkpoint);
    key_ = key_of(tracer, frame, options);
    resume(result_, key_, options);
  }

  AoReference run() {
    count_resumed();
    if (rows_done_ > 0) say_on_interruption(goes_on);
    for (const View& view : frame_.views) check_likeness(view, ViewTracer(tracer_, view, frame_.window));
    for (size_t i = 0; i < frame_.views.size(); ++i) trace(frame_.views[i], result_.frame.views[i]);
    summarise();
    return std::move(result_);
  }

 private:
  struct Tally {
    long long surfaces = 0, unlike = 0;
    int x = -1, y = -1;  ///< one pixel that is unlike
  };

  void count_resumed() {
    for (const View& view : result_.frame.views) {
      for (int y = 0; y < frame_.height(); ++y) rows_done_ += row_is_done(view.planes.at("ao").channels[0], y);
    }
    result_.resumed_share = double(rows_done_) / double(std::max(1LL, rows()));
  }

  long long rows() const { return (long long)frame_.height() * (long long)frame_.views.size(); }

  void trace(const View& view, View& out) {
    const ViewTracer pixels(tracer_, view, frame_.window);
    Channel& ao = out.planes.at("ao").channels[0];
    Channel& noise = out.planes.at("ao_noise").channels[0];
    std::exception_ptr failure;  // an exception may not leave a parallel loop
    std::atomic<bool> failed = false;
#pragma omp parallel for schedule(dynamic, 1)
    for (int y = 0; y < frame_.height(); ++y) {
      if (failed || row_is_done(ao, y)) continue;
      try {
        std::vector<float> open(size_t(frame_.width()), 1.0f), error(size_t(frame_.width()), 0.0f);
        const long long surfaces = trace_row(pixels, y, open, error);
        const std::lock_guard<std::mutex> lock(mutex_);
        std::copy(open.begin(), open.end(), ao.row(y));
        std::copy(error.begin(), error.end(), noise.row(y));
        finish_row(surfaces);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failed = true;
        failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
    out.planes["depth"] = view.planes.at("depth").clone();
  }

  /// Gives the number of pixels that are not background.
  long long trace_row(const ViewTracer& pixels, int y, std::vector<float>& open, std::vector<float>& error) const {
    long long surfaces = 0;
    for (int x = 0; x < frame_.width(); ++x) {
      if (pixels.is_background_at(x, y)) continue;
      bool alike = true;
      const Site site = pixels.site(x, y, alike);
      const uint32_t seed = hash(uint32_t(y) * 65536u + uint32_t(x)) + options_.seed;
      const double a = estimator_.open_share(site, hash(2 * seed)), b = estimator_.open_share(site, hash(2 * seed + 1));
      open[size_t(x)] = float(std::clamp((a + b) / 2, 0.0, 1.0));
      error[size_t(x)] = float(std::abs(a - b) / 2);
      ++surfaces;
    }
    return surfaces;
  }

  /// Called with the lock held.
  void finish_row(long long surfaces) {
    result_.rays += surfaces * estimator_.rays_per_pixel();
    ++rows_done_;
    if (options_.progress) options_.progress(double(rows_done_) / double(rows()));
    if (!options_.checkpoint.empty() && seconds_since(saved_) >= options_.checkpoint_seconds) save();
  }

  /// Not being able to is no reason to lose the work itself.
  void save() {
    saved_ = Clock::now();
    if (!can_save_) return;
    result_.frame.attributes[key_name] = key_;
    try {
      write_frame(options_.checkpoint, result_.frame);
      say_on_interruption(goes_on);
    } catch (const Error& error) {
      can_save_ = false;
      result_.notes.push_back(fmt::format("an interruption would have lost the work: {}", error.what()));
    }
    result_.frame.attributes.erase(key_name);
  }

  /// A frame of another scene is found before hours go into it: by a grid of pixels.
  void check_likeness(const View& view, const ViewTracer& pixels) {
    Tally tally;
    const int step_x = std::max(1, frame_.width() / 128), step_y = std::max(1, frame_.height() / 72);
    for (int y = step_y / 2; y < frame_.height(); y += step_y) {
      for (int x = step_x / 2; x < frame_.width(); x += step_x) {
        if (pixels.is_background_at(x, y)) continue;
        bool alike = true;
        pixels.site(x, y, alike);
        ++tally.surfaces;
        if (!alike) ++tally.unlike, tally.x = x, tally.y = y;
      }
    }
    if (tally.surfaces == 0) return;
    looked_at_ += tally.surfaces;
    unlike_ += tally.unlike;
    result_.unlike_share = double(unlike_) / double(looked_at_);
    if (4 * tally.unlike <= tally.surfaces) return;
    TracerRay ray = camera_ray(*view.camera, tracer_.scene().origin, frame_.window.x0 + tally.x + 0.5,
                               frame_.window.y0 + tally.y + 0.5);
    const std::optional<Surface> there = tracer_.first(ray);
    throw Error(
        "{}: is not what the frame shows: at pixel ({}, {}) the frame's depth is {:g} and the scene's is {}; "
        "check scene, camera and unit",
        tracer_.scene().name, tally.x, tally.y, view.planes.at("depth").channels[0].at(tally.x, tally.y),
        there ? fmt::format("{:g}", there->distance) : "that of the background");
  }

  void summarise() {
    long long count = 0;
    double squares = 0;
    for (size_t i = 0; i < frame_.views.size(); ++i) {
      const Channel& depth = frame_.views[i].planes.at("depth").channels[0];
      View& out = result_.frame.views[i];
      const Channel& noise = out.planes.at("ao_noise").channels[0];
      for (int y = 0; y < frame_.height(); ++y) {
        for (int x = 0; x < frame_.width(); ++x) {
          if (is_background(depth.at(x, y))) continue;
          const double error = noise.at(x, y);
          ++count;
          squares += error * error;
          result_.largest_noise = std::max(result_.largest_noise, error);
        }
      }
      out.planes.at("ao").channels[0].fill_padding(1);
      out.planes.at("ao_noise").channels[0].fill_padding(0);
    }
    result_.noise = std::sqrt(squares / double(std::max(1LL, count)));
    result_.seconds = seconds_since(start_);
    Frame& frame = result_.frame;
    frame.numbers["aoRadius"] = options_.radius;
    frame.numbers["aoSamples"] = estimator_.rays_per_pixel();
    frame.numbers["aoNoise"] = result_.noise;
    frame.attributes["aoFalloff"] = options_.falloff;
    if (!options_.falloff_parameters.empty()) frame.attributes["aoFalloffParameters"] = options_.falloff_parameters;
    frame.attributes["aoDefinition"] =
        options_.falloff == "none"
            ? "cosine-weighted share of directions in which nothing is nearer than aoRadius"
            : fmt::format("1 - cosine-weighted mean of the contribution of {} at the first hit within aoRadius",
                          options_.falloff);
    frame.attributes["gloamScene"] = tracer_.scene().name;
  }

  const Tracer& tracer_;
  const Frame& frame_;
  const AoReferenceOptions& options_;
  Estimator estimator_;
  AoReference result_;
  std::string key_;
  std::mutex mutex_;
  bool can_save_ = true;
  long long rows_done_ = 0, looked_at_ = 0, unlike_ = 0;
  Clock::time_point start_ = Clock::now(), saved_ = Clock::now();
};

void check_inputs(const Frame& frame, const AoReferenceOptions& options) {
  if (!(options.radius > 0))
    throw UsageError("a reference of radius {:g} sees nothing; more than 0 does", options.radius);
  if (options.samples < 1 || options.samples > (1 << 24))
    throw UsageError("{} samples are not allowed; 1 to {} are", options.samples, 1 << 24);
  for (const View& view : frame.views) {
    if (!view.find("depth")) throw Error("view '{}' has no depth", view.name);
    if (!view.camera || !view.camera->pose)
      throw Error("view '{}' has no pose, so that its place in the scene is unknown; give --camera FILE", view.name);
  }
}

}  // namespace

AoReference ao_reference(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options) {
  check_inputs(frame, options);
  return AoTracing(tracer, frame, options).run();
}

}  // namespace gloam
