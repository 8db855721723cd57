// What `gloam bench` measured, read from its bench.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gloam::report {

using Json = nlohmann::ordered_json;
using Number = std::optional<double>;  ///< empty: null or not in the file

struct Milliseconds {
  double median = 0, min = 0, max = 0;
};

struct Pass {
  std::string name;
  Milliseconds ms;
};

/// A part of a technique's time.
struct Share {
  std::string what;
  double share = 0;  ///< of 1
};

/// RMSE of each image to the one a step above it (docs/benchmarking.md).
struct Ladder {
  Number t0w, t1, t2, t3, t4_bias, t4_noise, t5;
};

/// One technique with one preset, in one variant, on one scene.
struct Row {
  std::string technique, preset, variant, scene;
  Milliseconds ms;
  Number rmse_to_truth, bias;
  Number ratio_to_hbao_plus, ratio_to_gather_floor, ratio_to_copy_floor, ratio_to_naive, ratio_to_native;
  Number own_floor_ms, ratio_to_own_floor;
  Ladder ladder;
  std::vector<Share> spent_on;
  std::vector<Pass> passes;
  Number width, height, lanes, samples;
  std::string resolution, math, storage;
  Json settings = Json::object();
  std::string image;  ///< path below the folder; empty: none
};

struct Scene {
  std::string name, scene_class;
  Number width, height, radius, radius_pixels, truth_noise;
  std::string truth_image;  ///< path below the folder; empty: none
};

struct Growth {
  std::string technique, over, scene;
  double exponent = 0;
  Number x_from, x_to, ms_from, ms_to;
};

struct Skipped {
  std::string technique, preset, scene, why;
};

/// A figure of a paper's table, beside ours.
struct PaperFigure {
  std::string table, row, column, base;
  Number ms, ratio, paper_ratio;
};

struct Measurements {
  std::string device, cpu, driver, date, commit;
  Number cores, rounds, rays;
  std::vector<Scene> scenes;  ///< every scene that a row names is here
  std::vector<Row> rows;
  std::vector<Growth> growth;
  std::vector<Skipped> skipped;
  std::vector<PaperFigure> paper;
};

/// Reads DIR/bench.json, of this version or an older one: what that did not have is empty. Throws Error naming the file
/// and the thing in it that is missing or of another kind.
Measurements read_measurements(const std::filesystem::path& folder);

}  // namespace gloam::report
