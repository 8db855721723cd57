#include "scene/reference_rows.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <mutex>

#include "base/elapsed.h"
#include "base/file_ledger.h"
#include "base/files.h"
#include "base/lists.h"
#include "base/low_discrepancy.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "gloam/scene/camera_ray.h"
#include "scene/fingerprint.h"

namespace gloam {
namespace {

using glm::dvec3;
using glm::vec3;
using Clock = std::chrono::steady_clock;

/// The attribute that makes a file a checkpoint.
constexpr const char* key_name = "gloamReferenceKey";

/// Message of an interrupted run once something is saved.
constexpr const char* goes_on = "run it again and it goes on where it was";

/// A surface counts as the frame's if its depth differs by at most this share.
constexpr double same_depth = 0.01;

// --- Checkpoints

/// Identifies a computation. The leading number is raised when the method changes.
std::string key_of(const Tracer& tracer, const Frame& frame, const RowsOptions& options) {
  Fingerprint print;
  print.add(tracer.scene());
  print.add(frame);
  return fmt::format("3: {} {}x{} {} {}", print.text(), frame.width(), frame.height(), options.value, options.key);
}

/// Throws Error if another file lies in the checkpoint's place: it may be somebody's.
void check_checkpoint(const std::filesystem::path& path) {
  std::error_code code;
  if (path.empty() || !std::filesystem::exists(std::filesystem::symlink_status(path, code))) return;
  bool ours = false;
  const LooksAtFiles looks;
  try {
    ours = std::filesystem::is_regular_file(path, code) && !FrameFile(path, {}).text_attribute(key_name).empty();
  } catch (const Error&) {
    // Not even an EXR.
  }
  if (!ours)
    throw Error("{}: an unfinished reference would be saved here, but this is another file; move it away",
                path.string());
}

/// Takes over rows of an interrupted run; unfinished pixels are NaN.
void resume(Reference& reference, const std::string& key, const RowsOptions& options) {
  Frame& result = reference.frame;
  if (options.checkpoint.empty() || !std::filesystem::exists(options.checkpoint)) return;
  const LooksAtFiles looks;
  try {
    ReadOptions as_stored;
    as_stored.as_stored = true;
    FrameFile file(options.checkpoint, as_stored);
    if (file.text_attribute(key_name) != key) {
      reference.notes.push_back(fmt::format("{}: held an unfinished reference with other settings, which is dropped",
                                            options.checkpoint.string()));
      return;
    }
    const std::vector<std::string> planes = {options.value, options.noise};
    Frame kept = file.read(planes);
    for (const std::string& name : planes) {
      if (!contains(file.common_planes(), name)) return;
    }
    for (View& view : result.views) {
      for (const std::string& name : planes) view.planes.at(name) = std::move(kept.view(view.name).planes.at(name));
    }
  } catch (const Error&) {
    // Damaged: computed anew and written over.
  }
}

bool row_is_done(const Channel& value, int y) { return !std::isnan(value.at(0, y)); }

// --- All pixels

class RowsTracing {
 public:
  RowsTracing(const Tracer& tracer, const Frame& frame, const RowsOptions& options)
      : tracer_(tracer), frame_(frame), options_(options) {
    result_.frame.display = frame.display;
    result_.frame.window = frame.window;
    result_.frame.pixel_aspect = frame.pixel_aspect;
    result_.frame.assumed = frame.assumed;
    const Layout layout(frame.width(), frame.height());
    for (const View& view : frame.views) {
      View& out = result_.frame.views.emplace_back(without_planes(view));
      for (const std::string& name : {options.value, options.noise}) {
        Plane& plane = out.planes[name];
        plane.name = name;
        for (size_t i = 0; i < plane_kind(name).components.size(); ++i)
          plane.channels.emplace_back(layout, std::numeric_limits<float>::quiet_NaN());
      }
    }
    check_checkpoint(options.checkpoint);
    key_ = key_of(tracer, frame, options);
    resume(result_, key_, options);
  }

  Reference run() {
    count_resumed();
    if (rows_done_ > 0) say_on_interruption(goes_on);
    for (const View& view : frame_.views) check_likeness(view, ViewTracer(tracer_, view, frame_.window));
    for (size_t i = 0; i < frame_.views.size(); ++i) trace(frame_.views[i], result_.frame.views[i]);
    summarise();
    return std::move(result_);
  }

 private:
  /// One row: each component of the value, then the noise.
  using Row = std::vector<std::vector<float>>;

  struct Tally {
    long long surfaces = 0, unlike = 0;
    int x = -1, y = -1;  ///< a pixel that is unlike the scene
  };

  void count_resumed() {
    for (const View& view : result_.frame.views) {
      for (int y = 0; y < frame_.height(); ++y)
        rows_done_ += row_is_done(view.planes.at(options_.value).channels[0], y);
    }
    result_.resumed_share = double(rows_done_) / double(std::max(1LL, rows()));
  }

  long long rows() const { return (long long)frame_.height() * (long long)frame_.views.size(); }

  void trace(const View& view, View& out) {
    const ViewTracer pixels(tracer_, view, frame_.window);
    std::vector<Channel>& value = out.planes.at(options_.value).channels;
    Channel& noise = out.planes.at(options_.noise).channels[0];
    std::exception_ptr failure;  // an exception may not leave a parallel loop
#pragma omp parallel for schedule(dynamic, 1)
    for (int y = 0; y < frame_.height(); ++y) {
      if (failed_ || row_is_done(value[0], y)) continue;
      try {
        Row row(value.size() + 1, std::vector<float>(size_t(frame_.width()), 0.0f));
        const long long rays = trace_row(pixels, y, row);
        if (failed_) continue;
        const std::lock_guard<std::mutex> lock(mutex_);
        // The first component is copied last: it marks the row as done.
        for (size_t i = 1; i < value.size(); ++i) std::copy(row[i].begin(), row[i].end(), value[i].row(y));
        std::copy(row.back().begin(), row.back().end(), noise.row(y));
        std::copy(row[0].begin(), row[0].end(), value[0].row(y));
        finish_row(rays);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failed_ = true;
        failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
    out.planes["depth"] = view.planes.at("depth").clone();
  }

  /// Returns the number of rays. Stops in the middle of the row where another thread has failed.
  long long trace_row(const ViewTracer& pixels, int y, Row& row) const {
    const size_t components = row.size() - 1;
    std::vector<float> value(components);
    long long rays = 0;
    for (int x = 0; x < frame_.width() && !failed_; ++x) {
      if (options_.poll) options_.poll();
      value = options_.background;
      float noise = 0;
      if (!pixels.is_background_at(x, y)) {
        bool alike = true;
        const Site site = pixels.site(x, y, alike);
        const uint32_t seed = hash(uint32_t(y) * 65536u + uint32_t(x));
        rays += options_.trace(pixels, site, x, y, seed, value.data(), noise);
      }
      for (size_t i = 0; i < components; ++i) row[i][size_t(x)] = value[i];
      row.back()[size_t(x)] = noise;
    }
    return rays;
  }

  /// Called with the lock held.
  void finish_row(long long rays) {
    result_.rays += rays;
    ++rows_done_;
    if (options_.progress) options_.progress(double(rows_done_) / double(rows()));
    if (!options_.checkpoint.empty() && seconds_since(saved_) >= options_.checkpoint_seconds) save();
  }

  /// A failed save does not stop the work.
  void save() {
    saved_ = Clock::now();
    if (!can_save_) return;
    result_.frame.attributes[key_name] = key_;
    try {
      write_frame(options_.checkpoint, result_.frame);
      say_on_interruption(goes_on);
    } catch (const Error& error) {
      can_save_ = false;
      result_.notes.push_back(fmt::format("the work could not be saved against interruptions: {}", error.what()));
    }
    result_.frame.attributes.erase(key_name);
  }

  /// Checks a grid of pixels, so that a frame of another scene is found before hours are spent on it.
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
      const Channel& noise = out.planes.at(options_.noise).channels[0];
      for (int y = 0; y < frame_.height(); ++y) {
        for (int x = 0; x < frame_.width(); ++x) {
          if (is_background(depth.at(x, y))) continue;
          const double error = noise.at(x, y);
          ++count;
          squares += error * error;
          result_.largest_noise = std::max(result_.largest_noise, error);
        }
      }
      for (const std::string& name : {options_.value, options_.noise}) {
        for (Channel& channel : out.planes.at(name).channels) channel.fill_padding(plane_kind(name).outside);
      }
    }
    result_.noise = std::sqrt(squares / double(std::max(1LL, count)));
    result_.seconds = seconds_since(start_);
    result_.frame.attributes["gloamScene"] = tracer_.scene().name;
  }

  const Tracer& tracer_;
  const Frame& frame_;
  const RowsOptions& options_;
  Reference result_;
  std::string key_;
  std::mutex mutex_;
  bool can_save_ = true;
  std::atomic<bool> failed_ = false;
  long long rows_done_ = 0, looked_at_ = 0, unlike_ = 0;
  Clock::time_point start_ = Clock::now(), saved_ = Clock::now();
};

}  // namespace

ViewTracer::ViewTracer(const Tracer& tracer, const View& view, const Window& window)
    : tracer_(tracer),
      view_(view),
      camera_(*view.camera),
      window_(window),
      depth_(view.planes.at("depth").channels[0]) {
  if (const Plane* normal = view.find("normal")) normal_ = &normal->channels;
  to_world_ = glm::transpose(camera_.pose->world_to_view);
}

bool ViewTracer::is_background_at(int x, int y) const { return is_background(depth_.at(x, y)); }

Site ViewTracer::site(int x, int y, bool& alike) const {
  TracerRay ray = camera_ray(camera_, tracer_.scene().origin, window_.x0 + x + 0.5, window_.y0 + y + 0.5);
  ray.near = camera_.near.value_or(0);
  const double depth = depth_.at(x, y);
  Site site;
  site.surface = surface_at(ray, depth, alike);
  site.to_eye = -glm::normalize(ray.direction);
  dvec3 normal(0);
  if (normal_) normal = to_world_ * dvec3((*normal_)[0].at(x, y), (*normal_)[1].at(x, y), (*normal_)[2].at(x, y));
  if (site.surface) {
    site.origin = tracer_.lifted(*site.surface);
    site.facing = vec3(site.surface->facing);
    if (glm::length(normal) < 0.5) normal = site.surface->normal;
  } else {
    if (glm::length(normal) < 0.5) normal = site.to_eye;
    site.origin = vec3(ray.origin + depth * (1 - 1e-4) * ray.direction);
    site.facing = vec3(normal);
  }
  site.to_world = frame_about(glm::normalize(normal));
  return site;
}

/// The first surface, or the one behind it that has the frame's depth.
std::optional<Surface> ViewTracer::surface_at(const TracerRay& ray, double depth, bool& alike) const {
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

int rounded_samples(int samples) {
  return std::max(1, (samples + 2 * rays_per_packet - 1) / (2 * rays_per_packet)) * 2 * rays_per_packet;
}

void check_views(const Frame& frame) {
  for (const View& view : frame.views) {
    if (!view.find("depth")) throw Error("view '{}' has no depth", view.name);
    if (!view.camera || !view.camera->pose)
      throw Error("view '{}' has no pose, so that its place in the scene is unknown; give {}", view.name,
                  option("camera", "FILE"));
  }
}

void check_radius(double radius) {
  if (!(radius > 0)) throw UsageError("a reference of radius {:g} is open everywhere; give more than 0", radius);
}

void check_samples(int samples) {
  if (samples < 1 || samples > (1 << 24)) throw UsageError("{} samples are not allowed; 1 to {} are", samples, 1 << 24);
}

void describe(Reference& reference, const std::string& name, int samples, const std::string& definition) {
  Frame& frame = reference.frame;
  frame.numbers[name + "Samples"] = samples;
  frame.numbers[name + "Noise"] = reference.noise;
  frame.attributes[name + "Definition"] = definition;
}

std::array<uint32_t, 2> seeds_of_halves(uint32_t pixel, uint32_t seed) {
  return {hash(2 * (pixel + seed)), hash(2 * (pixel + seed) + 1)};
}

Reference trace_rows(const Tracer& tracer, const Frame& frame, const RowsOptions& options) {
  return RowsTracing(tracer, frame, options).run();
}

}  // namespace gloam
