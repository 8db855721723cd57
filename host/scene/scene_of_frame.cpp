#include "scene/scene_of_frame.h"

#include "base/elapsed.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "scene/fingerprint.h"

namespace gloam {
namespace {

NamedScene scene_for(const NamedScene& given, const FrameFile& file) {
  if (!given.name.empty()) return given;
  NamedScene named = scene_in_attribute(file.text_attribute("gloamScene"));
  const std::string frame = file.path().string();
  if (named.name.empty())
    throw UsageError("{}: does not say which scene it shows; give {}", frame, option("scene", "SCENE"));
  if (!find_builtin_scene(named.name))
    throw UsageError("{}: shows '{}', which is not built in; give {}", frame, named.name, option("scene", "FILE"));
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

constexpr const char* moment = "time";

void check_settings(const Settings& settings, const ShotRecipe& shot) {
  for (const auto& [name, value] : settings) {
    if (name == moment)
      throw UsageError("{}: {} moves the objects and sets it in each frame; leave it out", option(name, value),
                       option("shot", shot.name));
  }
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

MovingScene::MovingScene(NamedScene scene, const ShotRecipe* shot, const std::optional<OutlineOptions>& outlines,
                         TellNotes tell)
    : named_(std::move(scene)),
      shot_(shot && shot->moves_objects ? shot : nullptr),
      outline_options_(outlines),
      tell_(std::move(tell)) {
  if (shot_) check_settings(named_.settings, *shot_);
  prepare(made_at(frame_));
}

std::shared_ptr<const Scene> MovingScene::made_at(int frame) {
  const auto start = std::chrono::steady_clock::now();
  NamedScene at = named_;
  if (shot_) at.settings.emplace_back(moment, fmt::format("{}", seconds_of_frame(frame)));
  auto scene = std::make_shared<const Scene>(load_scene(at, tell_));
  load_seconds_ += seconds_since(start);
  return scene;
}

void MovingScene::prepare(std::shared_ptr<const Scene> scene) {
  outlines_.reset();
  tracer_.reset();
  scene_ = std::move(scene);
  tracer_ = std::make_unique<const Tracer>(*scene_);
  build_seconds_ += tracer_->build_seconds();
  if (outline_options_) outlines_ = std::make_unique<const Outlines>(*tracer_, *outline_options_);
}

void MovingScene::go_to(int frame) {
  if (!shot_ || frame == frame_) return;
  previous_ = frame == frame_ + 1 ? scene_ : made_at(frame - 1);
  frame_ = frame;
  prepare(made_at(frame));
}

}  // namespace gloam
