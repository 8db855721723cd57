#include "gloam/history.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/lists.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// A plane of a history, and that of a result that it is.
struct PlaneOfHistory {
  std::string name, source;
};
using PlanesOfHistory = std::vector<PlaneOfHistory>;

const PlanesOfHistory& table() {
  static const PlanesOfHistory planes = {{"history", "reflection"},
                                         {"history_ao", "ao_raw"},
                                         {"history_indirect", "indirect_raw"},
                                         {"history_depth", "depth"},
                                         {"history_frames", "frames"}};
  return planes;
}

std::vector<std::string> column_of(std::string PlaneOfHistory::*column) {
  std::vector<std::string> names;
  for (const PlaneOfHistory& plane : table()) names.push_back(plane.*column);
  return names;
}

bool is_all_zero(const Plane& plane, int x, int y) {
  return std::all_of(plane.channels.begin(), plane.channels.end(),
                     [&](const Channel& channel) { return channel.at(x, y) == 0; });
}

/// A history of one frame for every surface; where a mask left pixels without a reflection, these have none.
Plane one_frame(const Plane& depth, const Plane* reflection) {
  Plane frames{"frames", {}};
  const Layout& layout = depth.channels.front().layout();
  Channel& counts = frames.channels.emplace_back(layout, 0.0f);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (is_background(depth.channels.front().at(x, y))) continue;
      if (!reflection || !is_all_zero(*reflection, x, y)) counts.at(x, y) = 1;
    }
  }
  return frames;
}

View* find_view(Frame& frame, const std::string& name) {
  const auto same =
      std::find_if(frame.views.begin(), frame.views.end(), [&](const View& view) { return view.name == name; });
  return same == frame.views.end() ? nullptr : &*same;
}

/// The view of the frame before that a view goes on from.
View& view_before(Frame& before, const Frame& frame, const View& view, const std::string& name) {
  if (View* same = find_view(before, view.name)) return *same;
  // A file that names no view is for the only view of the frame.
  const bool is_unnamed =
      before.views.size() == 1 && frame.views.size() == 1 && (view.name.empty() || before.views.front().name.empty());
  if (!is_unnamed)
    throw Error("{}: has no view '{}', which the frame has; give what gloam run wrote for that view", name, view.name);
  return before.views.front();
}

}  // namespace

const std::vector<std::string>& history_planes() {
  static const std::vector<std::string> names = column_of(&PlaneOfHistory::name);
  return names;
}

const std::vector<std::string>& planes_for_history() {
  static const std::vector<std::string> names = column_of(&PlaneOfHistory::source);
  return names;
}

bool is_of_history(const std::string& plane) { return contains(history_planes(), plane); }

bool has_history(const std::vector<std::string>& planes) {
  return std::any_of(planes.begin(), planes.end(), is_of_history);
}

bool knows_where_surfaces_were(const Frame& frame) {
  return std::any_of(frame.views.begin(), frame.views.end(), [](const View& view) {
    const bool has_poses = view.camera && view.camera->pose && view.camera_before && view.camera_before->pose;
    return has_poses || view.find("motion");
  });
}

bool goes_on_from_before(const Frame& result) {
  constexpr double least_share = 0.05;
  size_t surfaces = 0, known = 0;
  for (const View& view : result.views) {
    const Plane* frames = view.find("frames");
    if (!frames) continue;
    const Channel& counts = frames->channels.front();
    for (int y = 0; y < counts.layout().height; ++y) {
      for (int x = 0; x < counts.layout().width; ++x) {
        surfaces += counts.at(x, y) > 0;
        known += counts.at(x, y) > 1;
      }
    }
  }
  return double(known) >= least_share * double(surfaces);
}

namespace {

/// Planes of a history that knows nothing.
void add_nothing(View& view, const Layout& layout, const std::vector<std::string>& planes) {
  for (const std::string& plane : history_planes()) {
    if (contains(planes, plane)) view.planes[plane] = empty_plane(plane, layout);
  }
}

}  // namespace

void add_no_history(Frame& frame, const std::vector<std::string>& planes) {
  for (View& view : frame.views) add_nothing(view, Layout(frame.width(), frame.height()), planes);
}

void add_history(Frame& frame, Frame before, const std::vector<std::string>& planes, const std::string& name) {
  if (before.display != frame.display)
    throw Error("{}: shows {}, and the frame {}; frames of a sequence are of one size and place", name,
                in_words(before.display), in_words(frame.display));
  const bool has_some = std::any_of(frame.views.begin(), frame.views.end(),
                                    [&](const View& view) { return find_view(before, view.name) != nullptr; });
  for (View& view : frame.views) {
    // A technique may have results for one of two views.
    if (has_some && !find_view(before, view.name)) {
      add_nothing(view, Layout(frame.width(), frame.height()), planes);
      continue;
    }
    View& from = view_before(before, frame, view, name);
    view.camera_before = from.camera;
    if (!from.find("frames")) from.planes["frames"] = one_frame(from.planes.at("depth"), from.find("reflection"));
    for (const auto& [added, source] : table()) {
      if (!contains(planes, added) || !from.find(source)) continue;
      Plane& plane = view.planes[added] = std::move(from.planes.at(source));
      plane.name = added;
      if (before.window != frame.window) plane = part_of(plane, before.window, frame.window);
    }
  }
}

History::History(const std::filesystem::path& path) : file_(path, {}) {
  const std::vector<std::string> there = file_.common_planes();
  const auto refuse = [&](const std::string& lacks) {
    throw Error("{}: has no {}; give the file that gloam run --temporal wrote for the frame before, without --bare",
                option("history", path.string()), lacks);
  };
  const bool has_result = std::any_of(there.begin(), there.end(), [](const std::string& plane) {
    return plane == "reflection" || plane == "ao_raw" || plane == "indirect_raw";
  });
  if (!has_result) refuse("'reflection', 'ao_raw' or 'indirect_raw'");
  if (!contains(there, "depth")) refuse("'depth'");
}

std::vector<std::string> History::planes() const {
  const std::vector<std::string> there = file_.common_planes();
  std::vector<std::string> names;
  for (const auto& [name, source] : table()) {
    // Without `frames`, the file counts as one frame.
    if (contains(there, source) || source == "frames") names.push_back(name);
  }
  return names;
}

std::vector<std::string> History::planes_of_file() const {
  std::vector<std::string> names = planes_for_history();
  const std::vector<std::string> there = file_.common_planes();
  std::erase_if(names, [&](const std::string& name) { return !contains(there, name); });
  return names;
}

void History::add_to(Frame& frame, const std::vector<std::string>& planes) {
  add_history(frame, file_.read(planes_of_file()), planes, option("history", file_.path().string()));
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
