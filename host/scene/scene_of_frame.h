// The scene that a frame shows.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gloam/exr.h"
#include "gloam/scene/outlines.h"
#include "gloam/scene/tracer.h"
#include "scene/names.h"

namespace gloam {

/// The scene that the user names, else the built-in one that a frame's header names. It is kept, prepared for rays, as long as
/// frames show it.
class SceneOfFrame {
 public:
  /// `scene`: an empty name if the frames name it; its settings are added to theirs.
  SceneOfFrame(NamedScene scene, TellNotes tell) : given_(std::move(scene)), tell_(std::move(tell)) {}

  /// Loads the scene of a frame, if that is another one than the last. Throws UsageError for a frame that names none, or none that
  /// is built in; also throws as `load_scene` does. Tells if the user named another scene than the frame does: it may
  /// still be the right one, from a file that was moved or renamed.
  const Scene& load_for(const FrameFile& file);
  /// The scene loaded last, prepared when it is asked for.
  const Tracer& tracer();
  /// Identifies the scene loaded last: a built-in one by name and settings, a file by what is in it.
  const std::string& identity() const { return identity_; }

 private:
  const NamedScene given_;
  const TellNotes tell_;
  NamedScene loaded_;
  std::unique_ptr<const Scene> scene_;
  std::unique_ptr<const Tracer> tracer_;
  std::string identity_;
  bool is_noted_ = false;
};

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
