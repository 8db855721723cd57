#include "scene/scene_of_frame.h"

#include "gloam/error.h"
#include "scene/fingerprint.h"

namespace gloam {
namespace {

NamedScene scene_for(const NamedScene& given, const FrameFile& file) {
  if (!given.name.empty()) return given;
  NamedScene named = scene_in_attribute(file.text_attribute("gloamScene"));
  const std::string frame = file.path().string();
  if (named.name.empty()) throw UsageError("{}: does not say which scene it shows; give --scene SCENE", frame);
  if (!find_builtin_scene(named.name))
    throw UsageError("{}: shows '{}', which is not built in; give --scene and the file", frame, named.name);
  named.settings.insert(named.settings.end(), given.settings.begin(), given.settings.end());
  return named;
}

std::string identity_of_scene(const Scene& scene, bool is_built_in) {
  if (is_built_in) return scene.name;
  Fingerprint print;
  print.add(scene);
  print.add_light(scene);
  return scene.name + " " + print.text();
}

}  // namespace

const Scene& SceneOfFrame::load_for(const FrameFile& file) {
  const NamedScene wanted = scene_for(given_, file);
  if (!scene_ || wanted.name != loaded_.name || wanted.settings != loaded_.settings) {
    tracer_.reset();
    scene_.reset();
    scene_ = std::make_unique<const Scene>(load_scene(wanted, tell_));
    identity_ = identity_of_scene(*scene_, find_builtin_scene(wanted.name));
    loaded_ = wanted;
  }
  const std::string named = file.text_attribute("gloamScene");
  if (!is_noted_ && !named.empty() && named != scene_->name) {
    tell_({fmt::format("the frame says that it shows '{}', and the scene is '{}'", named, scene_->name)});
    is_noted_ = true;  // of many frames once
  }
  return *scene_;
}

const Tracer& SceneOfFrame::tracer() {
  if (!tracer_) tracer_ = std::make_unique<const Tracer>(*scene_);
  return *tracer_;
}

}  // namespace gloam
