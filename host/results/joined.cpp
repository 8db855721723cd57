#include "results/joined.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "gloam/error.h"

namespace gloam::report {
namespace {

/// Order of the classes; other classes follow.
constexpr std::array<const char*, 5> class_order{"architecture", "thin", "object", "flat", "own"};

/// Ambient occlusion first, then other effects; within an effect by class.
std::tuple<bool, std::string, size_t> rank(const Scene& scene) {
  const std::string scene_class = scene.scene_class.substr(0, scene.scene_class.find(" ("));
  return {scene.effect != "ao", scene.effect,
          size_t(std::find(class_order.begin(), class_order.end(), scene_class) - class_order.begin())};
}

std::string size_of(const Scene& scene) {
  return scene.width && scene.height ? fmt::format("{:.0f}x{:.0f}", *scene.width, *scene.height) : "";
}

/// Sizes and devices that something was measured on.
struct Places {
  std::set<std::string> sizes, devices;
  void add(const Scene& scene, const Source& source) {
    sizes.insert(size_of(scene));
    devices.insert(source.measurements.device);
  }
  /// " at 480x270 on a device": only what differs between sources.
  std::string told(const Scene& scene, const Source& source) const {
    std::string text;
    if (sizes.size() > 1) text += " at " + size_of(scene);
    if (devices.size() > 1) text += " on " + source.measurements.device;
    return text;
  }
};

/// The scenes of one source, renamed so that they differ from those of the others.
Measurements renamed(const Source& source, size_t index, const std::map<std::string, Places>& places) {
  Measurements m = source.measurements;
  std::map<std::string, std::string> names;
  for (Scene& scene : m.scenes) {
    scene.source = index;
    names[scene.name] = scene.name + places.at(scene.name).told(scene, source);
    scene.name = names[scene.name];
  }
  const auto rename = [&](std::string& name) {
    if (const auto found = names.find(name); found != names.end()) name = found->second;
  };
  for (auto* rows : {&m.rows, &m.submitted}) {
    for (Row& row : *rows) {
      row.source = index;
      rename(row.scene);
    }
  }
  for (Converged& each : m.converged) rename(each.scene);
  for (ScaleChange& each : m.scales) rename(each.scene);
  return m;
}

/// Appends entries that may occur only once.
class Joining {
 public:
  explicit Joining(const std::vector<Source>& sources) : sources_(sources) {}

  void add(const Measurements& m, size_t source) {
    for (const Scene& scene : m.scenes) add(scene);
    for (const Row& row : m.rows) add(row, all.rows);
    for (const Row& row : m.submitted) add(row, all.submitted);
    for (const Converged& each : m.converged) {
      if (!is_there(each) && is_new(each.scene, each.technique + ", converged", source)) all.converged.push_back(each);
    }
    all.scales.insert(all.scales.end(), m.scales.begin(), m.scales.end());
    all.planes.insert(all.planes.end(), m.planes.begin(), m.planes.end());
  }

  Measurements all;

 private:
  std::string file(size_t source) const { return sources_[source].file.string(); }

  void add(const Scene& scene) {
    const auto is_it = [&](const Scene& other) { return other.name == scene.name; };
    const auto before = std::find_if(all.scenes.begin(), all.scenes.end(), is_it);
    if (before == all.scenes.end()) {
      all.scenes.push_back(scene);
    } else if (before->radius && scene.radius && *before->radius != *scene.radius) {
      throw Error("{}: the scene '{}' has a radius of {:g}, and of {:g} in {}; leave one of the two files out",
                  file(scene.source), scene.name, *scene.radius, *before->radius, file(before->source));
    }
  }

  /// The layers of several techniques are those of one other: files that divide the techniques of a scene each have its figures.
  bool is_there(const Converged& each) const {
    return std::any_of(all.converged.begin(), all.converged.end(), [&](const Converged& other) {
      return other.technique == each.technique && other.scene == each.scene && other.bias == each.bias &&
             other.rmse_to_truth == each.rmse_to_truth;
    });
  }

  /// False for an entry that is there already.
  bool is_new(const std::string& scene, const std::string& what, size_t source) {
    const auto [before, added] = source_of_.emplace(std::make_pair(scene, what), source);
    if (!added && before->second != source)
      throw Error("{}: {} on the scene '{}' is also in {}; a page shows it once, leave one of the two files out",
                  file(source), what, scene, file(before->second));
    return added;
  }

  void add(const Row& row, std::vector<Row>& rows) {
    std::string setting = row.technique + " " + row.preset;
    if (!row.variant.empty()) setting += ", " + row.variant;
    if (is_new(row.scene, setting, row.source)) rows.push_back(row);
  }

  const std::vector<Source>& sources_;
  std::map<std::pair<std::string, std::string>, size_t> source_of_;  ///< scene and what was measured on it
};

}  // namespace

std::filesystem::path folder_of(const Source& source) {
  const std::filesystem::path folder = source.file.parent_path();
  return folder.empty() ? "." : folder;
}

Measurements joined(const std::vector<Source>& sources) {
  std::map<std::string, Places> places;
  for (const Source& source : sources) {
    for (const Scene& scene : source.measurements.scenes) places[scene.name].add(scene, source);
  }
  Joining joining(sources);
  for (size_t i = 0; i < sources.size(); ++i) joining.add(renamed(sources[i], i, places), i);
  std::stable_sort(joining.all.scenes.begin(), joining.all.scenes.end(),
                   [](const Scene& a, const Scene& b) { return rank(a) < rank(b); });
  return joining.all;
}

Measurements by_group(Measurements joined, const std::vector<Source>& sources) {
  std::map<std::string, Places> places;
  for (const Scene& scene : joined.scenes) places[scene.scene_class].add(scene, sources[scene.source]);
  for (Scene& scene : joined.scenes) {
    const std::string where = places.at(scene.scene_class).told(scene, sources[scene.source]);
    if (scene.scene_class == "own")
      scene.scene_class = "own frame " + scene.name;
    else
      scene.scene_class = (scene.scene_class.empty() ? "scenes without a class" : scene.scene_class) + where;
  }
  return joined;
}

}  // namespace gloam::report
