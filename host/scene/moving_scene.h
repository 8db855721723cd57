// The scene that a capture's frames show.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gloam/scene/outlines.h"
#include "gloam/scene/tracer.h"
#include "scene/names.h"

namespace gloam {

/// A scene, prepared for rays. Where a shot moves its objects, it is made and prepared anew for each frame.
class MovingScene {
 public:
  /// The scene of the shot's first frame. `shot`: null if nothing but the camera moves. Throws as `load_scene` does, and
  /// UsageError for a parameter that the shot sets.
  MovingScene(NamedScene scene, const ShotRecipe* shot, const std::optional<OutlineOptions>& outlines, TellNotes tell);

  void go_to(int frame);

  const Scene& scene() const { return *scene_; }
  const Tracer& tracer() const { return *tracer_; }
  /// None where none are asked for.
  const Outlines* outlines() const { return outlines_.get(); }
  /// The scene of the frame before; null where it is the same.
  const Scene* previous() const { return previous_.get(); }
  /// Over all frames.
  double load_seconds() const { return load_seconds_; }
  double build_seconds() const { return build_seconds_; }

 private:
  std::shared_ptr<const Scene> made_at(int frame);
  void prepare(std::shared_ptr<const Scene> scene);

  const NamedScene named_;
  const ShotRecipe* shot_;
  const std::optional<OutlineOptions> outline_options_;
  const TellNotes tell_;
  int frame_ = 1;
  std::shared_ptr<const Scene> scene_, previous_;
  std::unique_ptr<const Tracer> tracer_;
  std::unique_ptr<const Outlines> outlines_;
  double load_seconds_ = 0, build_seconds_ = 0;
};

}  // namespace gloam
