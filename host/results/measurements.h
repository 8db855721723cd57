// Measurements of `gloam bench`, read from its bench.json.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gloam::report {

using Json = nlohmann::ordered_json;
using Number = std::optional<double>;  ///< empty: null or not in the file

struct Milliseconds {
  double median = 0, min = 0, max = 0;
  std::vector<double> rounds = {};  ///< empty in files that keep none
};

/// What a pass does for each pixel, by count (docs/benchmarking.md).
struct PassCount {
  double operations = 0, loads = 0, bytes_loaded = 0, bytes_stored = 0;
};

struct Pass {
  std::string name;
  Milliseconds ms;
  std::optional<PassCount> per_pixel;  ///< empty: not counted
};

/// What the device reached at most on a scene's frame.
struct Peaks {
  Number copy_gb_per_s, gather_g_per_s, fma_gflops;
};

/// The ratios of each round: of times, and of what the cores spent. Empty in older files, or where there is nothing to compare with.
struct RoundRatios {
  std::vector<double> ms, cpu;
};

/// A part of a technique's time.
struct Share {
  std::string what;
  double share = 0;  ///< 0 to 1
};

/// The ladder: RMSE of each image to the one a step above it (docs/benchmarking.md).
struct Ladder {
  Number t0w, t1, t2, t12, t3, t4_bias, t4_noise, t5;
};

/// Time of a part of a technique relative to naive kernels that compute the same.
struct AgainstNaive {
  std::string part;  ///< "estimate", "filter" or "both"
  double ratio = 0;  ///< the technique's time over theirs
};

/// The inputs of a technique.
struct Reads {
  std::vector<std::string> depths;  ///< "depth", and stacks of further layers: "peel", "stochastic"
  int views = 1;                    ///< views that a frame needs
};

/// Whether it reads peeled layers, which are available only from some renderers.
bool reads_peeled_layers(const Reads& reads);
/// Whether it reads only the depth of its own view, which every renderer has.
bool reads_one_layer(const Reads& reads);

/// One technique with one preset, in one variant, on one scene.
struct Row {
  std::string technique, preset, variant, scene;
  std::string effect;  ///< of its scene
  std::string kind;    ///< of its item of a set: "frame", "sequence", "eyes", ...; empty without a set
  Reads reads;
  Milliseconds ms;
  Number rmse_to_truth, bias;
  Number ssim, flip, flicker, inconsistency;
  Number ratio_to_hbao_plus, ratio_to_gather_floor, ratio_to_copy_floor, ratio_to_naive, ratio_to_native;
  RoundRatios hbao_plus_rounds, gather_floor_rounds, copy_floor_rounds;
  std::vector<double> processes;  ///< rounds in each process, one after another; empty: all in one
  Number own_floor_ms, ratio_to_own_floor;
  Ladder ladder;
  std::vector<AgainstNaive> naive;
  std::vector<Share> spent_on;
  std::vector<Pass> passes;
  Number width, height, lanes, samples;
  std::string resolution, math, real, storage;
  Json settings = Json::object();
  std::string image;  ///< path below the folder; empty: none
  size_t source = 0;  ///< index of its file, of several (joined.h)
  Json submitted;     ///< of a submitted row (gloam score): what its authors state (submitted.h); null for others
};

/// One scene with one effect of light on it. Name and class tell the effect, unless it is ambient occlusion: "gallery (indirect)". Of a
/// set the class is of single frames; other kinds are classes of their own, since other techniques compute pairs of eyes and displays.
struct Scene {
  std::string name, scene_class;
  std::string own_class;      ///< as the file has it: "architecture"
  std::string title, effect;  ///< name without the effect; the plane: "ao", "indirect"
  std::string kind;           ///< of its item of a set; empty without a set
  Number width, height, radius, radius_pixels, truth_noise;
  std::string radius_from;  ///< "flag", "frame", "scene", "truth"; empty in older files
  std::string truth_image;  ///< path below the folder; empty: none
  std::string base;         ///< what there is without a technique: "white"; empty in older files
  Number base_rmse, base_bias;
  double white = 1;  ///< value that pictures show as white
  std::optional<Peaks> peaks;
  size_t source = 0;  ///< index of its file, of several (joined.h)
};

struct Growth {
  std::string technique, over, scene;
  double exponent = 0;
  Number x_from, x_to, ms_from, ms_to;
};

struct Skipped {
  std::string technique, preset, scene, why;
};

/// A figure from a paper's table, with ours.
struct PaperFigure {
  std::string table, row, column, base;
  Number ms, ratio, paper_ratio;
};

/// A technique with so many samples that more change nothing, compared with the truth.
struct Converged {
  std::string technique, scene;
  Number rmse_to_truth, bias;
  Reads reads;
  std::string effect;
};

/// Difference between an image computed at one size and the same image computed at another.
struct ScaleChange {
  std::string technique, scene;
  std::string from, to;     ///< sizes: "480x270"
  Number mean_change, mae;  ///< mean of the differences, and of their absolute values
};

/// A technique's result on a plane, which should be open everywhere: 1.
struct PlaneReading {
  std::string technique, plane;  ///< the plane it made: "ao_raw", "ao"
  double least = 1;
  Number mean, tilt, direction;  ///< angles in degrees
  std::string camera;            ///< "perspective", "orthographic"
  Number x, y;                   ///< the pixel of the least value
};

/// One technique with one preset on the frames of a shot.
struct SequenceRow {
  std::string technique, preset;
  bool temporal = false;  ///< accumulated over the frames
  Milliseconds ms;        ///< of one frame
  Number ratio_to_hbao_plus, rmse, worst_rmse, worst_frame, ssim, flicker;
};

/// The frames of a shot (gloam bench --sequence).
struct Sequence {
  std::string shot;
  size_t frames = 0;
  Number width, height, radius, truth_rays, truth_change;
  std::vector<SequenceRow> rows;
};

/// The frozen set that was measured on; the name is empty where there was none.
struct SetFacts {
  std::string name, part, hash;
  Number seed;
};

/// How many of the hard cases that concern a technique it holds (gloam stress).
struct HeldCases {
  size_t held = 0, cases = 0;
};

struct Measurements {
  std::string device, cpu, driver, date, commit;
  std::string gloam;                 ///< the version; empty in older files
  std::vector<std::string> command;  ///< as given; empty in older files
  SetFacts set;
  Number cores, rounds, rays;
  std::vector<Scene> scenes;  ///< every scene that a row names is here
  std::vector<Row> rows;      ///< measured by gloam
  std::vector<Row>
      submitted;  ///< of other methods (gloam score): errors, and no time that compares with those of `rows`
  std::vector<Growth> growth;
  std::vector<Skipped> skipped;
  std::vector<PaperFigure> paper;
  std::vector<Converged> converged;
  std::vector<ScaleChange> scales;
  std::vector<PlaneReading> planes;
  std::optional<Sequence> sequence;
  std::map<std::string, HeldCases> stability;  ///< by technique, where the file says it
};

/// Reads DIR/bench.json, of this version or an older one: fields that an older version lacks are empty, and a technique's inputs
/// follow from the prefix of its name (technique/ambient_occlusion.h). Throws Error naming the file and the missing or mistyped
/// entry.
Measurements read_measurements(const std::filesystem::path& folder);

/// The same from its content; `name` is the file's.
Measurements measurements_of(const Json& document, const std::string& name);

/// The bench.json that a path names: the file itself, or the one in the folder. Throws Error if there is neither.
std::filesystem::path measurements_file(const std::filesystem::path& folder_or_file);

/// As `read_measurements`, from a file of any name, which may hold only `converged`, `scales`, `planes` or a sequence.
Measurements read_measurements_file(const std::filesystem::path& file);

}  // namespace gloam::report
