// Scenes and their cameras by the names that users and headers give.
#pragma once

#include <string>

#include "gloam/scene/scene.h"

namespace gloam {

/// A camera of a scene by its name; the first one for an empty name. Throws UsageError with the names that there are.
const SceneCamera& named_camera(const Scene& scene, const std::string& name);

/// A scene as `load_scene` (scene.h) takes it.
struct NamedScene {
  std::string name;
  Settings settings;
};

/// The scene of a frame by its attribute gloamScene: "statue: faces=500000". An empty name for an empty text.
NamedScene scene_in_attribute(const std::string& attribute);

}  // namespace gloam
