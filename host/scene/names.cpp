#include "scene/names.h"

#include <sstream>
#include <vector>

#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

const SceneCamera& named_camera(const Scene& scene, const std::string& name) {
  if (name.empty()) return scene.cameras.front();
  std::vector<std::string> names;
  for (const SceneCamera& camera : scene.cameras) {
    if (camera.name == name) return camera;
    names.push_back(camera.name);
  }
  throw UsageError("{}: {} has no camera of that name{}; it has {}, and a camera JSON can be given",
                   option("camera", name), scene.name, suggestion(name, names), enumerate(names));
}

Scene load_scene(const NamedScene& named, const TellNotes& tell) {
  Scene scene = load_scene(named.name, named.settings);
  tell(scene.notes);
  return scene;
}

NamedScene scene_in_attribute(const std::string& attribute) {
  const size_t colon = attribute.find(": ");
  NamedScene named{attribute.substr(0, colon), {}};
  if (colon == std::string::npos) return named;
  std::istringstream rest(attribute.substr(colon + 2));
  for (std::string item; rest >> item;) {
    const size_t equals = item.find('=');
    if (equals != std::string::npos) named.settings.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  return named;
}

}  // namespace gloam
