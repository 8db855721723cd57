// The scene that a frame shows.
#pragma once

#include <memory>
#include <string>

#include "gloam/exr.h"
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

}  // namespace gloam
