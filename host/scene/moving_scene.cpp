#include "scene/moving_scene.h"

#include "base/elapsed.h"
#include "gloam/error.h"

namespace gloam {
namespace {

constexpr const char* moment = "time";

void check_settings(const Settings& settings, const ShotRecipe& shot) {
  for (const auto& [name, value] : settings) {
    if (name == moment)
      throw UsageError("--{} {}: --shot {} moves the objects and sets it in each frame; leave it out", name, value,
                       shot.name);
  }
}

}  // namespace

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
