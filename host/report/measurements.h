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

/// A part of a technique beside naive kernels that compute the same.
struct AgainstNaive {
  std::string part;  ///< "estimate", "filter" or "both"
  double ratio = 0;  ///< the technique's time over theirs
};

/// What a technique looks at.
struct Reads {
  std::vector<std::string> depths;  ///< "depth", and stacks of further layers: "peel", "stochastic"
  int views = 1;                    ///< that a frame needs
};

/// Peeled layers: no choice where a renderer gives one.
bool reads_peeled_layers(const Reads& reads);
/// Nothing but the depth of its own view, which every renderer has.
bool reads_one_layer(const Reads& reads);

/// One technique with one preset, in one variant, on one scene.
struct Row {
  std::string technique, preset, variant, scene;
  Reads reads;
  Milliseconds ms;
  Number rmse_to_truth, bias;
  Number ratio_to_hbao_plus, ratio_to_gather_floor, ratio_to_copy_floor, ratio_to_naive, ratio_to_native;
  Number own_floor_ms, ratio_to_own_floor;
  Ladder ladder;
  std::vector<AgainstNaive> naive;
  std::vector<Share> spent_on;
  std::vector<Pass> passes;
  Number width, height, lanes, samples;
  std::string resolution, math, storage;
  Json settings = Json::object();
  std::string image;  ///< path below the folder; empty: none
  size_t source = 0;  ///< which of several files it is from (joined.h)
};

struct Scene {
  std::string name, scene_class;
  Number width, height, radius, radius_pixels, truth_noise;
  std::string truth_image;  ///< path below the folder; empty: none
  size_t source = 0;        ///< which of several files it is from (joined.h)
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

/// A technique with so many samples that more change nothing, against the truth.
struct Converged {
  std::string technique, scene;
  Number rmse_to_truth, bias;
  Reads reads;
};

/// What an image computed at one size differs by from the same computed at another.
struct ScaleChange {
  std::string technique, scene;
  std::string from, to;     ///< sizes: "480x270"
  Number mean_change, mae;  ///< mean of the differences, and of their absolute values
};

/// What a technique makes of a plane, which is open everywhere: 1.
struct PlaneReading {
  std::string technique, plane;  ///< the plane it made: "ao_raw", "ao"
  double least = 1;
  Number mean, tilt, direction;  ///< angles in degrees
  std::string camera;            ///< "perspective", "orthographic"
  Number x, y;                   ///< the pixel of the least value
};

struct Measurements {
  std::string device, cpu, driver, date, commit;
  Number cores, rounds, rays;
  std::vector<Scene> scenes;  ///< every scene that a row names is here
  std::vector<Row> rows;
  std::vector<Growth> growth;
  std::vector<Skipped> skipped;
  std::vector<PaperFigure> paper;
  std::vector<Converged> converged;
  std::vector<ScaleChange> scales;
  std::vector<PlaneReading> planes;
};

/// Reads DIR/bench.json, of this version or an older one: what that did not have is empty, and what a technique reads is
/// taken from the prefixes of names (technique/ambient_occlusion.h). Throws Error naming the file
/// and the thing in it that is missing or of another kind.
Measurements read_measurements(const std::filesystem::path& folder);

/// The bench.json that a path names: the file itself, or that in the folder. Throws Error where there is neither.
std::filesystem::path measurements_file(const std::filesystem::path& folder_or_file);

/// The same from a file of any name, which may also hold nothing but `converged`, `scales` or `planes`.
Measurements read_measurements_file(const std::filesystem::path& file);

}  // namespace gloam::report
