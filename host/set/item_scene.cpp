#include "set/item_scene.h"

#include <algorithm>

#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/scene/light_field_capture.h"
#include "scene/names.h"
#include "set/set_files.h"

namespace gloam::sets {

ItemScene::ItemScene(const ItemRecipe& item) : item_(item) {
  if (item.shot.empty()) return;
  for (const ShotRecipe& shot : find_builtin_scene(item.scene)->shots) {
    if (shot.name == item.shot) shot_ = &shot;
  }
}

std::shared_ptr<const Scene> ItemScene::made_at(int frame) const {
  Settings settings = item_.settings;
  if (shot_ && shot_->moves_objects) settings.emplace_back("time", fmt::format("{}", seconds_of_frame(frame)));
  return std::make_shared<const Scene>(load_scene(item_.scene, settings));
}

const Tracer& ItemScene::tracer(int frame) {
  const bool stands = tracer_ && (frame == frame_ || !shot_ || !shot_->moves_objects);
  if (stands) return *tracer_;
  tracer_.reset();
  scene_ = made_at(frame);
  tracer_ = std::make_unique<const Tracer>(*scene_, Tracing::reproducible);
  frame_ = frame;
  return *tracer_;
}

std::vector<CaptureView> ItemScene::views(int frame) {
  const auto of_shot = [&](int number) {
    return camera_for(shot_->camera(seconds_of_frame(std::max(number, 1))), item_.width, item_.height);
  };
  if (shot_) return {{"", of_shot(frame), of_shot(frame - 1)}};
  const SceneCamera& camera = item_.placed ? *item_.placed : named_camera(*scene_, item_.camera);
  if (item_.display.empty()) return {{"", camera_for(camera, item_.width, item_.height), {}}};
  const LightFieldDisplay display = display_from_text(display_text(item_.display), item_.display);
  const FittingSize size = fitting_size(display);
  const auto fitted = fitted_to(display, *tracer_, camera_for(camera, size.width, size.height));
  if (!fitted) throw Error("{}: the camera shows no surface that the display could show", item_.name);
  return module_views(*fitted, item_.width, item_.height);
}

Frame ItemScene::capture_frame(int frame, int layers, const std::function<void(int, int)>& progress) {
  const Tracer& now = tracer(frame);
  std::shared_ptr<const Scene> before;
  if (shot_ && shot_->moves_objects) before = made_at(std::max(frame - 1, 1));
  CaptureOptions options{.width = item_.width, .height = item_.height};
  options.planes = capture_planes();
  std::erase(options.planes, "emission");  // sets were frozen without it
  if (!shot_) std::erase(options.planes, "motion");
  options.peel = layers;
  options.peel_light = item_.with_light;
  options.views = views(frame);
  options.stereo = item_.eyes;
  options.previous_scene = before.get();
  options.progress = progress;
  Frame made = capture(now, options).frame;
  made.numbers["aoRadius"] = item_.radius;
  return made;
}

}  // namespace gloam::sets
