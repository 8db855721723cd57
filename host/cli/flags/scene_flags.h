// Flags of the commands that load a scene.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/flags/options.h"
#include "gloam/scene/scene.h"
#include "scene/names.h"

namespace gloam::cli {

/// "1,2,3". Throws UsageError.
glm::dvec3 parse_point(const std::string& text, const std::string& flag);

/// The scene, and its settings.
struct SceneFlags {
  std::string scene;
  std::vector<std::string> settings;
  /// Adds the settings only: the scene itself is an argument of `capture` and a flag of other commands.
  void add_settings_to(CLI::App& app);
  /// By its settings as they are. Throws UsageError for one without a value.
  NamedScene named() const;
  /// Removes and returns the settings of techniques, which have a dot in the name: {"hbao+.bias", "0.2"}.
  Settings take_dotted_settings();
};

/// The camera of a scene.
struct SceneCameraFlags {
  std::string camera;
  std::optional<glm::dvec3> eye, target;
  std::optional<double> fov;
  void add_to(CLI::App& app);
  bool any() const { return !camera.empty() || fov || eye || target; }
  /// Cameras by view. Throws UsageError for a camera that the scene lacks (with the nearest name).
  std::vector<std::pair<std::string, Camera>> cameras(const Scene& scene, int width, int height) const;
};

}  // namespace gloam::cli
