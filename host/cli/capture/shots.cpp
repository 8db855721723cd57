#include "cli/capture/shots.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "camera/camera_json.h"
#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "gloam/scene/light_field_capture.h"

namespace gloam::cli {
namespace {

/// Throws UsageError for a camera file with several views: two views are made from one.
void check_single_view(const CaptureCommand& flags, const std::vector<CaptureView>& views) {
  if ((!flags.view2 && !flags.stereo) || views.size() == 1) return;
  std::vector<std::string> names;
  for (const CaptureView& view : views) names.push_back("'" + view.name + "'");
  const char* flag = flags.view2 ? "--view2" : "--stereo";
  throw UsageError("{} makes two views of one, and {} has {}; leave out {}, or give a camera of one view", flag,
                   flags.camera.camera, enumerate(names), flag);
}

/// The file of a frame: by the pattern, or "frame.0007.exr" for "frame.exr".
std::string numbered(const std::string& path, const std::string& flag, int number) {
  if (path.empty()) return "";
  if (FramePattern::is_pattern(path)) return FramePattern(path, flag).path_of(number).string();
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{:04}{}", p.stem().string(), number, p.extension().string())).string();
}

/// The shot of a built-in scene.
const ShotRecipe& named_shot(const std::string& scene, const std::string& name) {
  const SceneRecipe* recipe = find_builtin_scene(scene);
  if (!recipe)
    throw UsageError("--shot {}: '{}' is not a built-in scene, and only these have shots; give --camera-path FILE",
                     name, scene);
  std::vector<std::string> names;
  for (const ShotRecipe& shot : recipe->shots) {
    if (shot.name == name) return shot;
    names.push_back(shot.name);
  }
  if (names.empty())
    throw UsageError("--shot {}: {} has no shots; gloam list shots shows those that there are", name, scene);
  throw UsageError("--shot {}: {} has no shot of that name{}; it has {}", name, scene, suggestion(name, names),
                   enumerate(names));
}

/// The frames to make, all of them frames of the path.
std::vector<int> chosen_frames(const CaptureCommand& flags, const CameraPath& path) {
  const int last = int(path.cameras.size());
  std::vector<int> frames;
  if (flags.choice.frames) {
    frames = *flags.choice.frames;
  } else {
    for (int frame = 1; frame <= last; ++frame) frames.push_back(frame);
  }
  for (const int frame : {frames.front(), frames.back()}) {
    if (frame < 1 || frame > last) throw UsageError("--frames {}: {} has frames 1 to {}", frame, path.flag, last);
  }
  return frames;
}

/// "frame.exr" and "module07" make "frame.module07.exr".
std::string of_view(const std::string& path, const std::string& view) {
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{}{}", p.stem().string(), view, p.extension().string())).string();
}

/// The modules that --modules names, by number and from-to; all without it.
std::vector<size_t> chosen_modules(const CaptureCommand& flags, size_t count) {
  std::vector<size_t> chosen;
  if (flags.modules.empty()) {
    for (size_t i = 0; i < count; ++i) chosen.push_back(i);
    return chosen;
  }
  for (const auto& [from, to] : parse_modules(flags.modules, "--modules")) {
    check_number(from, "--modules", {0, int(count) - 1});
    check_number(to, "--modules", {from, int(count) - 1});
    for (int i = from; i <= to; ++i) {
      if (std::find(chosen.begin(), chosen.end(), size_t(i)) != chosen.end())
        throw UsageError("--modules {}: names module {} twice; name each once", flags.modules, i);
      chosen.push_back(size_t(i));
    }
  }
  return chosen;
}

/// What a display shows if it states no part of the world: the image of a camera of one view.
Camera framing_camera(const CaptureCommand& flags, const Scene& scene, const FittingSize& size) {
  const auto cameras = flags.camera.cameras(scene, size.width, size.height);
  if (cameras.size() != 1)
    throw UsageError("--display {}: shows what one camera frames, and {} has {}; give a camera of one view",
                     flags.display, flags.camera.camera, cameras.size());
  return cameras.front().second;
}

/// The display at each frame, with the part of the world that it shows: the one that the display states, or a camera's image at
/// its middle depth, which comes to lie in the screen. Along a path that is the depth in the first frame: the display moves with
/// the camera, and its world does not jump.
std::vector<LightFieldDisplay> displays_for(const CaptureCommand& flags, const Tracer& tracer, const CameraPath* path) {
  const LightFieldDisplay display = read_display(flags.display);
  if (display.world && !path && !flags.camera.any()) return {display};
  if (display.world)
    throw UsageError("--display {}: states which part of the world it shows; leave out {}", flags.display,
                     path ? flags.moving() : "--camera, --eye, --target and --fov");
  const FittingSize size = fitting_size(display);
  const std::vector<Camera> cameras =
      path ? path->cameras : std::vector<Camera>{framing_camera(flags, tracer.scene(), size)};
  const std::optional<double> depth = fitting_depth(display, tracer, cameras.front());
  if (!depth)
    throw Error(
        "--display {}: the camera shows nothing of the scene that the display could; another --camera or --eye may",
        flags.display);
  std::vector<LightFieldDisplay> displays;
  for (const Camera& camera : cameras)
    displays.push_back(fitted_to(display, camera, {0, 0, size.width, size.height}, *depth));
  return displays;
}

}  // namespace

std::vector<std::pair<int, int>> parse_modules(const std::string& text, const std::string& flag) {
  constexpr Range<int> numbers = {0, std::numeric_limits<int>::max()};
  std::vector<std::pair<int, int>> items;
  try {
    for (const std::string& item : split_list(text, flag)) {
      const size_t dash = item.find('-');
      const int first = parse_number(item.substr(0, dash), flag, numbers);
      const int last = dash == std::string::npos ? first : parse_number(item.substr(dash + 1), flag, numbers);
      items.emplace_back(first, last);
    }
  } catch (const UsageError&) {
    throw UsageError("{} {} is not allowed; numbers and ranges are, such as 0,5,10-19", flag, text);
  }
  return items;
}

std::vector<CaptureShot> shots_of_display(const CaptureCommand& flags, const Tracer& tracer, CaptureOptions& options,
                                          const CameraPath* path) {
  const std::vector<LightFieldDisplay> displays = displays_for(flags, tracer, path);
  if (!flags.size) options.width = displays.front().width, options.height = displays.front().height;
  const std::vector<size_t> modules = chosen_modules(flags, displays.front().modules.size());
  const auto views_at = [&](int frame) {
    return module_views(displays[size_t(std::max(frame, 1)) - 1], options.width, options.height);
  };
  std::vector<CaptureShot> shots;
  for (const int frame : path ? chosen_frames(flags, *path) : std::vector<int>{1}) {
    const std::vector<CaptureView> views = views_at(frame), before = views_at(frame - 1);
    const std::string file = path ? numbered(flags.out, "-o", frame) : flags.out,
                      picture = path ? numbered(flags.picture, "--picture", frame) : flags.picture;
    if (!flags.separate) shots.push_back({file, picture, {}, frame});
    for (const size_t i : modules) {
      const std::string& name = views[i].name;
      if (flags.separate)
        shots.push_back({of_view(file, name), picture.empty() ? "" : of_view(picture, name), {}, frame});
      shots.back().views.push_back(views[i]);
      if (path) shots.back().views.back().previous_camera = before[i].camera;
    }
  }
  return shots;
}

std::optional<CameraPath> path_of(const CaptureCommand& flags, int width, int height) {
  if (!flags.path.empty()) {
    std::vector<std::string> assumed;
    CameraPath path{"--camera-path " + flags.path, read_camera_path(flags.path, {0, 0, width, height}, assumed)};
    note(assumed);
    return path;
  }
  if (flags.shot.empty()) return {};
  const ShotRecipe& shot = named_shot(flags.scene.scene, flags.shot);
  CameraPath path{"--shot " + flags.shot, {}, &shot};
  for (int frame = 1; frame <= shot.frames; ++frame) {
    path.cameras.push_back(camera_for(shot.camera(seconds_of_frame(frame)), width, height));
    path.cameras.back().source = fmt::format("shot '{}'", shot.name);
  }
  return path;
}

CaptureShot single_shot(const CaptureCommand& flags, const Scene& scene, int width, int height) {
  CaptureShot shot{flags.out, flags.picture, {}};
  for (const auto& [name, camera] : flags.camera.cameras(scene, width, height))
    shot.views.push_back({name, camera, {}});
  check_single_view(flags, shot.views);
  return shot;
}

std::vector<CaptureShot> shots_of_path(const CaptureCommand& flags, const CameraPath& path) {
  std::vector<CaptureShot> shots;
  for (const int frame : chosen_frames(flags, path)) {
    const size_t i = size_t(frame) - 1;
    shots.push_back({numbered(flags.out, "-o", frame),
                     numbered(flags.picture, "--picture", frame),
                     {{"", path.cameras[i], path.cameras[i == 0 ? 0 : i - 1]}},
                     frame});
  }
  return shots;
}

}  // namespace gloam::cli
