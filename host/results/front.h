// The Pareto front: settings for which no other is at least as fast and as near to the truth, and better in one of the two.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/measurements.h"

namespace gloam::report {

/// Smaller is better for both; any units.
struct Cost {
  double time = 0, error = 0;
};

/// Indices of the points on the front, fastest first. A point is on it if no other has a time and an error that are both no
/// larger, one of them smaller: two equal points are both on it. A point that is not finite never is.
std::vector<size_t> pareto_front(const std::vector<Cost>& points);

/// The time that a front uses.
enum class TimeOf { ratio, ms };

/// The front of one scene; indices into the rows.
struct SceneFront {
  TimeOf time = TimeOf::ratio;  ///< ms if a row with an error has no ratio to HBAO+
  size_t candidates = 0;        ///< rows with a time and an error
  std::vector<size_t> all;      ///< over every row of the scene
  std::vector<size_t> plain;    ///< over the rows whose variant is ""
};

SceneFront front_of_scene(const std::vector<Row>& rows, const std::string& scene);

/// One setting over the scenes of a class.
struct ClassPoint {
  std::string technique, preset, variant;
  Reads reads;
  double error = 0, ratio = 0;      ///< means over the scenes
  Number bias;                      ///< mean over the scenes; empty if a scene has none
  bool on_front = false;            ///< on the front of the means, over all settings
  bool on_plain_front = false;      ///< on the front of the means, over settings whose variant is ""
  std::vector<std::string> fronts;  ///< scenes of the class that have it on their own front, over all settings
};

/// The front of a class of scenes.
struct ClassFront {
  std::string name;
  std::vector<std::string> scenes;  ///< those with an error and a ratio; the means are over all of them
  std::vector<ClassPoint> points;   ///< settings measured in all of the scenes, fastest first
  size_t left_out = 0;              ///< settings measured in only some of the scenes: their means would not compare
  std::string effect;               ///< of its scenes: "ao", "indirect"
};

/// One front per class, in order of first appearance; none for a class without a scene that has errors and ratios.
std::vector<ClassFront> fronts_of_classes(const Measurements& measurements);

}  // namespace gloam::report
