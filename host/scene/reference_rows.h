// Tracing a reference pixel by pixel: rows on all threads, kept now and then, against the frame that it belongs to.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/scene/reference.h"

namespace gloam {

/// Where a pixel's rays start, and the hemisphere that they fill.
struct Site {
  glm::vec3 origin;
  glm::vec3 facing;                ///< of the triangle: directions below it are closed
  glm::dmat3 to_world;             ///< columns: two tangents and the normal
  glm::dvec3 to_eye;               ///< unit, world
  std::optional<Surface> surface;  ///< none where the scene has nothing under the pixel
};

/// One view of the frame in front of its scene.
class ViewTracer {
 public:
  ViewTracer(const Tracer& tracer, const View& view, const Window& window);

  bool is_background_at(int x, int y) const;
  /// Where a foreground pixel's rays start. `alike`: whether the scene has a surface where the frame says.
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

/// What is traced, and how a computation is known and kept.
struct RowsOptions {
  std::string value, noise;       ///< planes that are made; the second has one component
  std::vector<float> background;  ///< of `value`, one per component
  std::string key;  ///< tells one computation from another: all that the result depends on but scene and frame
  std::filesystem::path checkpoint;
  double checkpoint_seconds = 15;
  std::function<void(double share_done)> progress;
  /// Fills `value`, one number per component, and `noise` for a foreground pixel; gives the number of rays that it took.
  std::function<long long(const ViewTracer& pixels, const Site& site, int x, int y, uint32_t seed, float* value,
                          float& noise)>
      trace;
};

/// The planes of `options` for every view of the frame, with its depth and cameras. Throws as `ao_reference` does for a frame
/// that does not fit the scene, and for a checkpoint's place that is taken.
Reference trace_rows(const Tracer& tracer, const Frame& frame, const RowsOptions& options);

/// Throws Error for a view without depth or pose.
void check_views(const Frame& frame);

/// `samples` per pixel as packets make them: two halves of whole packets.
int rounded_samples(int samples);
inline constexpr int rays_per_packet = 16;

}  // namespace gloam
