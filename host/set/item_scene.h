// The scene, the camera and the captured frames of an item.
#pragma once

#include <memory>

#include "gloam/scene/capture.h"
#include "set/recipe.h"

namespace gloam::sets {

/// An item's scene, prepared for reproducible rays when it is asked for; where a shot moves its objects, for each frame anew.
class ItemScene {
 public:
  explicit ItemScene(const ItemRecipe& item);

  /// `frame`: a number of a sequence's, else 0.
  const Tracer& tracer(int frame);
  /// Every plane that can be captured, in all views; motion in a sequence. `progress`: as in CaptureOptions.
  Frame capture_frame(int frame, int layers, const std::function<void(int done, int of)>& progress);

 private:
  std::shared_ptr<const Scene> made_at(int frame) const;
  std::vector<CaptureView> views(int frame);

  const ItemRecipe& item_;
  const ShotRecipe* shot_ = nullptr;
  int frame_ = -1;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<const Tracer> tracer_;
};

}  // namespace gloam::sets
