#include "results/front.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/lists.h"

namespace gloam::report {
namespace {

bool is_finite(const Cost& cost) { return std::isfinite(cost.time) && std::isfinite(cost.error); }

bool beats(const Cost& a, const Cost& b) {
  return a.time <= b.time && a.error <= b.error && (a.time < b.time || a.error < b.error);
}

/// The front over some of the rows, as indices of rows.
std::vector<size_t> front_over(const std::vector<size_t>& chosen, const std::vector<Cost>& costs) {
  std::vector<Cost> points;
  for (const size_t i : chosen) points.push_back(costs[i]);
  std::vector<size_t> front;
  for (const size_t i : pareto_front(points)) front.push_back(chosen[i]);
  return front;
}

using Setting = std::tuple<std::string, std::string, std::string>;
Setting setting_of(const Row& row) { return {row.technique, row.preset, row.variant}; }

/// Setting -> scene -> row. If a setting was measured twice in a scene, the first row counts.
using BySetting = std::map<Setting, std::map<std::string, size_t>>;

BySetting rows_by_setting(const std::vector<Row>& rows, const std::vector<std::string>& scenes) {
  BySetting found;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (contains(scenes, rows[i].scene) && rows[i].rmse_to_truth && rows[i].ratio_to_hbao_plus)
      found[setting_of(rows[i])].emplace(rows[i].scene, i);
  }
  return found;
}

ClassPoint mean_point(const Setting& setting, const std::map<std::string, size_t>& rows_of_scenes,
                      const std::vector<Row>& rows) {
  ClassPoint point;
  std::tie(point.technique, point.preset, point.variant) = setting;
  point.reads = rows[rows_of_scenes.begin()->second].reads;
  const double scenes = double(rows_of_scenes.size());
  point.bias = 0;
  for (const auto& [scene, index] : rows_of_scenes) {
    const Row& row = rows[index];
    point.error += *row.rmse_to_truth / scenes;
    point.ratio += *row.ratio_to_hbao_plus / scenes;
    point.bias = point.bias && row.bias ? Number(*point.bias + *row.bias / scenes) : Number();
  }
  return point;
}

void mark_fronts(std::vector<ClassPoint>& points) {
  std::vector<Cost> costs;
  std::vector<size_t> all, plain;
  for (size_t i = 0; i < points.size(); ++i) {
    costs.push_back({points[i].ratio, points[i].error});
    all.push_back(i);
    if (points[i].variant.empty()) plain.push_back(i);
  }
  for (const size_t i : front_over(all, costs)) points[i].on_front = true;
  for (const size_t i : front_over(plain, costs)) points[i].on_plain_front = true;
}

ClassFront front_of_class(const std::string& name, const std::vector<std::string>& scenes,
                          const std::vector<Row>& rows) {
  ClassFront found{.name = name, .scenes = scenes};
  std::map<std::string, std::vector<Setting>> on_front;
  for (const std::string& scene : scenes) {
    for (const size_t i : front_of_scene(rows, scene).all) on_front[scene].push_back(setting_of(rows[i]));
  }
  for (const auto& [setting, of_scenes] : rows_by_setting(rows, scenes)) {
    if (of_scenes.size() < scenes.size()) {
      ++found.left_out;
      continue;
    }
    ClassPoint point = mean_point(setting, of_scenes, rows);
    for (const std::string& scene : scenes) {
      const std::vector<Setting>& front = on_front[scene];
      if (std::find(front.begin(), front.end(), setting) != front.end()) point.fronts.push_back(scene);
    }
    found.points.push_back(std::move(point));
  }
  std::stable_sort(found.points.begin(), found.points.end(), [](const ClassPoint& a, const ClassPoint& b) {
    return std::tie(a.ratio, a.error) < std::tie(b.ratio, b.error);
  });
  mark_fronts(found.points);
  return found;
}

}  // namespace

std::vector<size_t> pareto_front(const std::vector<Cost>& points) {
  std::vector<size_t> front;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto beats_it = [&](const Cost& other) { return is_finite(other) && beats(other, points[i]); };
    if (is_finite(points[i]) && std::none_of(points.begin(), points.end(), beats_it)) front.push_back(i);
  }
  std::stable_sort(front.begin(), front.end(), [&](size_t a, size_t b) { return points[a].time < points[b].time; });
  return front;
}

SceneFront front_of_scene(const std::vector<Row>& rows, const std::string& scene) {
  SceneFront front;
  std::vector<size_t> all, plain;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].scene != scene || !rows[i].rmse_to_truth) continue;
    all.push_back(i);
    if (rows[i].variant.empty()) plain.push_back(i);
    if (!rows[i].ratio_to_hbao_plus) front.time = TimeOf::ms;
  }
  std::vector<Cost> costs(rows.size());
  for (const size_t i : all)
    costs[i] = {front.time == TimeOf::ratio ? *rows[i].ratio_to_hbao_plus : rows[i].ms.median, *rows[i].rmse_to_truth};
  front.candidates = all.size();
  front.all = front_over(all, costs);
  front.plain = front_over(plain, costs);
  return front;
}

std::vector<ClassFront> fronts_of_classes(const Measurements& measurements) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> scenes_of;
  std::map<std::string, std::string> effect_of;  ///< the name of a class tells its effect
  for (const Scene& scene : measurements.scenes) {
    const auto has_both = [&](const Row& row) {
      return row.scene == scene.name && row.rmse_to_truth && row.ratio_to_hbao_plus;
    };
    if (std::none_of(measurements.rows.begin(), measurements.rows.end(), has_both)) continue;
    add_new(names, scene.scene_class);
    effect_of[scene.scene_class] = scene.effect;
    scenes_of[scene.scene_class].push_back(scene.name);
  }
  std::vector<ClassFront> fronts;
  for (const std::string& name : names) {
    fronts.push_back(front_of_class(name, scenes_of[name], measurements.rows));
    fronts.back().effect = effect_of[name];
  }
  return fronts;
}

}  // namespace gloam::report
