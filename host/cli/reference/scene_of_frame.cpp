#include "cli/reference/scene_of_frame.h"

#include "cli/flags/notes.h"
#include "gloam/error.h"
#include "scene/fingerprint.h"

namespace gloam::cli {
namespace {

SceneFlags scene_for(const SceneFlags& given, const FrameFile& file) {
  if (!given.scene.empty()) return given;
  SceneFlags named = scene_named_by(file.text_attribute("gloamScene"));
  const std::string frame = file.path().string();
  if (named.scene.empty()) throw UsageError("{}: does not say which scene it shows; give --scene SCENE", frame);
  if (!find_builtin_scene(named.scene))
    throw UsageError("{}: shows '{}', which is not built in; give --scene and the file", frame, named.scene);
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
  const SceneFlags wanted = scene_for(flags_, file);
  if (!scene_ || wanted.scene != loaded_.scene || wanted.settings != loaded_.settings) {
    tracer_.reset();
    scene_.reset();
    scene_ = std::make_unique<const Scene>(wanted.load());
    identity_ = identity_of_scene(*scene_, find_builtin_scene(wanted.scene));
    loaded_ = wanted;
  }
  const std::string named = file.text_attribute("gloamScene");
  if (!is_noted_ && !named.empty() && named != scene_->name) {
    note({fmt::format("the frame says that it shows '{}', and the scene is '{}'", named, scene_->name)});
    is_noted_ = true;  // of many frames once
  }
  return *scene_;
}

const Tracer& SceneOfFrame::tracer() {
  if (!tracer_) tracer_ = std::make_unique<const Tracer>(*scene_);
  return *tracer_;
}

}  // namespace gloam::cli
