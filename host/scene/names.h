// Scenes and their cameras by the names that users and headers give.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/scene/scene.h"

namespace gloam {

/// A camera of a scene by its name; the first one for an empty name. Throws UsageError with the names that there are.
const SceneCamera& named_camera(const Scene& scene, const std::string& name);

/// A scene as `load_scene` (scene.h) takes it.
struct NamedScene {
  std::string name;
  Settings settings;
};

/// Where notes go: repairs of a scene, and what was assumed, a sentence each.
using TellNotes = std::function<void(const std::vector<std::string>&)>;

/// Loads a scene, and tells its notes. Throws as `load_scene`.
Scene load_scene(const NamedScene& named, const TellNotes& tell);

/// The scene of a frame by its attribute gloamScene: "statue: faces=500000". An empty name for an empty text.
NamedScene scene_in_attribute(const std::string& attribute);

}  // namespace gloam
