#include "gloam/history.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "lists.h"

namespace gloam {
namespace {

/// One frame for every surface.
Plane one_frame(const Plane& depth) {
  Plane frames{"frames", {}};
  const Layout& layout = depth.channels.front().layout();
  Channel& counts = frames.channels.emplace_back(layout, 0.0f);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) counts.at(x, y) = is_background(depth.channels.front().at(x, y)) ? 0.f : 1.f;
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

void History::add_to(Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> read = {"reflection", "depth"};
  if (contains(file_.common_planes(), "frames")) read.push_back("frames");
  Frame before = file_.read(read);
  if (before.width() != frame.width() || before.height() != frame.height())
    throw Error("--history {}: is {}x{} pixels, and the frame {}x{}; frames of a sequence are of one size",
                file_.path().string(), before.width(), before.height(), frame.width(), frame.height());
  for (View& view : frame.views) {
    const auto same = std::find_if(before.views.begin(), before.views.end(),
                                   [&](const View& other) { return other.name == view.name; });
    const bool only_one = before.views.size() == 1 && frame.views.size() == 1;
    if (same == before.views.end() && !only_one)
      throw Error("--history {}: has no view '{}', which the frame has", file_.path().string(), view.name);
    View& from = only_one ? before.views.front() : *same;
    const auto add = [&](const std::string& name, Plane plane) {
      if (!contains(planes, name)) return;
      plane.name = name;
      view.planes[name] = std::move(plane);
    };
    view.camera_before = from.camera;
    const Plane& depth = from.planes.at("depth");
    add("history_frames", from.find("frames") ? from.find("frames")->clone() : one_frame(depth));
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
