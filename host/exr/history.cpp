#include "gloam/history.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/lists.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// A history of one frame for every surface with a reflection: pixels that a mask left out have none.
Plane one_frame(const Plane& depth, const Plane& reflection) {
  Plane frames{"frames", {}};
  const Layout& layout = depth.channels.front().layout();
  Channel& counts = frames.channels.emplace_back(layout, 0.0f);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const bool has_any = std::any_of(reflection.channels.begin(), reflection.channels.end(),
                                       [&](const Channel& channel) { return channel.at(x, y) != 0; });
      if (has_any && !is_background(depth.channels.front().at(x, y))) counts.at(x, y) = 1;
    }
  }
  return frames;
}

}  // namespace

History::History(const std::filesystem::path& path) : file_(path, {}) {
  for (const char* plane : {"reflection", "depth"}) {
    if (contains(file_.common_planes(), plane)) continue;
    throw Error("--history {}: has no '{}'; give the file that gloam run wrote for the frame before, without --bare",
                path.string(), plane);
  }
}

const std::vector<std::string>& History::planes() {
  static const std::vector<std::string> names = {"history", "history_depth", "history_frames"};
  return names;
}

const std::vector<std::string>& History::planes_of_file() {
  static const std::vector<std::string> names = {"reflection", "depth", "frames"};
  return names;
}

void History::add_to(Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> there = planes_of_file();
  std::erase_if(there, [&](const std::string& plane) { return !contains(file_.common_planes(), plane); });
  Frame before = file_.read(there);
  if (before.window != frame.window || before.display != frame.display)
    throw Error("--history {}: shows {}, and the frame {}; frames of a sequence are of one size and place",
                file_.path().string(), in_words(before.window), in_words(frame.window));
  for (View& view : frame.views) {
    const auto same = std::find_if(before.views.begin(), before.views.end(),
                                   [&](const View& other) { return other.name == view.name; });
    // A file that names no view is for the only view of the frame.
    const bool is_unnamed =
        before.views.size() == 1 && frame.views.size() == 1 && (view.name.empty() || before.views.front().name.empty());
    if (same == before.views.end() && !is_unnamed)
      throw Error("--history {}: has no view '{}', which the frame has; give what gloam run wrote for that view",
                  file_.path().string(), view.name);
    View& from = same == before.views.end() ? before.views.front() : *same;
    const auto add = [&](const std::string& name, Plane plane) {
      if (!contains(planes, name)) return;
      plane.name = name;
      view.planes[name] = std::move(plane);
    };
    view.camera_before = from.camera;
    const Plane& depth = from.planes.at("depth");
    add("history_frames",
        from.find("frames") ? from.find("frames")->clone() : one_frame(depth, from.planes.at("reflection")));
    add("history_depth", depth.clone());
    add("history", std::move(from.planes.at("reflection")));
  }
}

std::optional<int> History::seed() const {
  const std::string run = file_.text_attribute("gloamRun"), key = "seed=";
  const size_t at = run.find(key);
  if (at == std::string::npos) return {};
  int seed = 0;
  const auto [end, error] = std::from_chars(run.data() + at + key.size(), run.data() + run.size(), seed);
  return error == std::errc() && seed >= 0 ? std::optional(seed) : std::nullopt;
}

}  // namespace gloam
