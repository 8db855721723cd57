// Tracing a reference pixel by pixel: rows on all threads, saved now and then, compared with the frame.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/scene/reference.h"

namespace gloam {

/// The start of a pixel's rays, and the hemisphere that they fill.
struct Site {
  glm::vec3 origin;
  glm::vec3 facing;                ///< of the triangle: directions below it are closed
  glm::dmat3 to_world;             ///< columns: two tangents and the normal
  glm::dvec3 to_eye;               ///< unit, world
  std::optional<Surface> surface;  ///< none if the scene has nothing under the pixel
};

/// One view of the frame with its scene.
class ViewTracer {
 public:
  ViewTracer(const Tracer& tracer, const View& view, const Window& window);

  bool is_background_at(int x, int y) const;
  /// The start of a foreground pixel's rays. `alike`: whether the scene has a surface at the frame's depth.
  Site site(int x, int y, bool& alike) const;
  const View& view() const { return view_; }

 private:
  std::optional<Surface> surface_at(const TracerRay& ray, double depth, bool& alike) const;

  const Tracer& tracer_;
  const View& view_;
  const Camera& camera_;
  Window window_;
  const Channel& depth_;
  const std::vector<Channel>* normal_ = nullptr;
  glm::dmat3 to_world_;
};

/// The quantity to trace, and how a computation is identified and saved.
struct RowsOptions {
  std::string value, noise;       ///< planes to make; the second has one component
  std::vector<float> background;  ///< of `value`, one per component
  std::string key;                ///< identifies a computation: all inputs but scene and frame
  std::filesystem::path checkpoint;
  double checkpoint_seconds = 15;
  std::function<void(double share_done)> progress;
  std::function<void()> poll;
  /// Fills `value`, one number per component, and `noise` for a foreground pixel; returns the number of rays.
  std::function<long long(const ViewTracer& pixels, const Site& site, int x, int y, uint32_t seed, float* value,
                          float& noise)>
      trace;
};

/// Rows of a quantity with the plane `value`, its noise beside it, traced with what the options of all kinds of reference have.
template <typename Options>
RowsOptions rows_of(const std::string& value, std::vector<float> background, const Options& options) {
  RowsOptions rows;
  rows.value = value;
  rows.noise = value + "_noise";
  rows.background = std::move(background);
  rows.checkpoint = options.checkpoint;
  rows.checkpoint_seconds = options.checkpoint_seconds;
  rows.progress = options.progress;
  rows.poll = options.poll;
  return rows;
}

/// Throws UsageError for a radius or a number of samples that is not allowed.
void check_radius(double radius);
void check_samples(int samples);

/// Adds what every reference states about itself: `name` with Samples, Noise and Definition.
void describe(Reference& reference, const std::string& name, int samples, const std::string& definition);

/// Makes the planes of `options` for every view of the frame, with its depth and cameras. Throws as `ao_reference` does for a
/// frame that does not fit the scene, and if another file lies in the checkpoint's place.
Reference trace_rows(const Tracer& tracer, const Frame& frame, const RowsOptions& options);

/// Throws Error for a view without depth or pose.
void check_views(const Frame& frame);

/// Seeds of the two halves of a pixel's rays.
std::array<uint32_t, 2> seeds_of_halves(uint32_t pixel, uint32_t seed);

/// Sets `value` to the mean of two halves, and returns half of their difference, as the mean over the components.
template <typename Half>
float mean_of_halves(const Half& a, const Half& b, float* value) {
  double difference = 0;
  for (int i = 0; i < Half::length(); ++i) {
    value[i] = float((a[i] + b[i]) / 2);
    difference += (a[i] - b[i]) / 2;
  }
  return float(std::abs(difference) / Half::length());
}

/// `samples` per pixel rounded up to two halves of whole packets.
int rounded_samples(int samples);
inline constexpr int rays_per_packet = 16;

}  // namespace gloam
