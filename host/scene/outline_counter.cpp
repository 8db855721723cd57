#include "scene/outline_counter.h"

#include "gloam/planes.h"
#include "gloam/scene/camera_ray.h"
#include "scene/captured_pixels.h"

namespace gloam {

OutlineCounter::OutlineCounter(const Outlines* outlines, const Camera& camera, const CaptureTarget& target)
    : outlines_(outlines), camera_(camera), target_(target) {
  if (!outlines_ || camera.orthographic || camera.slits) return;
  at_eye_ = outlines_->around(camera.pose->position - outlines_->scene().origin);
}

void OutlineCounter::row(int y) const {
  if (!outlines_) return;
  for (int x = 0; x < target_.depth->layout().width; ++x) {
    if (!shows(camera_, x, y)) continue;
    // From the eye on, whatever the near plane hides: an outline before that plane contains the eye too.
    TracerRay ray = camera_ray(camera_, outlines_->scene().origin, x + 0.5, y + 0.5);
    const float depth = target_.depth->at(x, y);
    ray.far = is_background(depth) ? far_of(camera_) : double(depth);
    // Each orthographic ray has its own start; most starts have nothing behind them.
    const int at_start = at_eye_ ? *at_eye_ : outlines_->around(ray.origin, -ray.direction);
    target_.outline_count->at(x, y) = float(at_start + outlines_->crossings(ray));
  }
}

}  // namespace gloam
