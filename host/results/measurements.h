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
  std::vector<double> rounds = {};    ///< empty in files that keep none
  std::vector<double> interval = {};  ///< of the median, its two ends; empty: none
};

/// What a pass does for each pixel of a frame, counted once on small frames (script/update-operation-counts).
struct PassCount {
  double operations = 0;  ///< on floats; a fused multiply-add is two
  double loads = 0;       ///< of one value from a plane
  double bytes_loaded = 0, bytes_stored = 0;
  double instructions = 0;        ///< of any kind, before a compiler's last optimisations; 0 in older files
  double float_instructions = 0;  ///< of these, the arithmetic, comparisons and selections of floats
  double bytes_of_planes = 0;     ///< of the planes read and written, each once
  bool looks_around = false;      ///< reads far around each pixel (`Footprint::is_wide`)
};

/// What limits a pass, and how much of its time that takes at the device's peak.
struct Bound {
  std::string by;  ///< "instructions", "reads" or "copies"
  double share = 0;
};

struct Pass {
  std::string name;
  Milliseconds ms;
  std::optional<PassCount> per_pixel;  ///< empty: not counted
  std::optional<Bound> bound = {};     ///< empty: not known
};

/// What the device reached at most on a scene's frame, in the rounds of its race.
struct Peaks {
  Number copy_gb_per_s;   ///< one plane read, one written
  Number gather_g_per_s;  ///< 10^9 values read at the addresses of HBAO+'s samples
  Number fma_gflops;      ///< 10^9 operations on floats by fused multiply-adds, two each
};

/// The ratios of each round: of times, and of what the cores spent, with their intervals. Empty in older files, or where there is nothing
/// to compare with.
struct RoundRatios {
  std::vector<double> ms, cpu, ms_interval = {}, cpu_interval = {};
};

/// A part of a technique's time.
struct Share {
  std::string what;  ///< "gathers", "arithmetic of the estimate", or a pass: "bilateral/separable"
  double share = 0;  ///< 0 to 1
};

/// The ladder: RMSE of each image to the one a step above it (docs/benchmarking.md); none if one of the two is missing.
struct Ladder {
  Number t0w;       ///< truth with the technique's own contribution, to the truth
  Number t1;        ///< over all peeled layers and converged, to the image above
  Number t2;        ///< over the given layers, converged, to the image above
  Number t12;       ///< the same to T0w, where the registry has no form over peeled layers: both steps in one
  Number t3;        ///< with its own samples, in double, to the image above
  Number t4_bias;   ///< filtered converged image, to the converged image
  Number t4_noise;  ///< filtered, to the filtered converged image
  Number t5;        ///< shipped result, to the same in double
};

/// A part of a technique, and the naive kernels that compute the same.
struct AgainstNaive {
  std::string part;  ///< "estimate", "filter" or "both"
  Milliseconds ms, naive_ms;
  double ratio = 0;  ///< the technique's time over theirs
  /// Mean and largest absolute difference between the two results up to this part, over all pixels; none for the filter alone.
  Number mean_difference, max_difference;
};

/// The inputs of a technique.
struct Reads {
  std::vector<std::string> depths;  ///< "depth", and stacks of further layers: "peel", "stochastic"
  int views = 1;                    ///< views that a frame needs
};

/// Whether it reads peeled layers, which are available only from some renderers.
bool reads_peeled_layers(const Reads& reads);

/// "all layers", "some layers", "two views" or "one layer": what a renderer has to give.
std::string in_words(const Reads& reads);
/// Whether it reads only the depth of its own view, which every renderer has.
bool reads_one_layer(const Reads& reads);

/// One technique with one preset, in one variant, on one scene.
struct Row {
  bool is_of_frames = true;  ///< whether it has all fields, as rows of single frames that gloam measured
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
  Number own_floor_ms, ratio_to_own_floor, copy_floor_ms;
  std::optional<Milliseconds> cpu_ms;  ///< what the cores spent; none where the device is no CPU
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

/// What there is without a technique.
struct Base {
  std::string name;  ///< "white", "black"; empty in older files
  Number rmse, bias;
};

/// One scene with one effect of light on it. Name and class tell the effect, unless it is ambient occlusion: "gallery (indirect)". Of a
/// set the class is of single frames; other kinds are classes of their own, since other techniques compute pairs of eyes and displays.
struct Scene {
  std::string name, scene_class;
  std::string effect;            ///< the plane: "ao", "indirect"
  std::string title, own_class;  ///< for pages: name and class as the file has them: "gallery", "architecture"
  std::string kind;              ///< of its item of a set; empty without a set
  Number width, height, radius, radius_pixels, truth_noise, truth_rays;
  std::string radius_from;  ///< "flag", "frame", "scene", "truth"; empty in older files
  std::string truth_image;  ///< path below the folder; empty: none
  Base base;
  double white = 1;                                      ///< value that pictures show as white
  std::optional<std::vector<std::string>> made, reused;  ///< files of a truth that was traced from the scene
  std::optional<Peaks> peaks;
  size_t source = 0;  ///< index of its file, of several (joined.h)
};

struct GrowthPoint {
  double x = 0;   ///< pixels, samples per pixel, pixels of radius, layers or views
  double ms = 0;  ///< median
};

struct Growth {
  std::string technique, over, scene;  ///< over: "pixels", "samples", "radius", "layers" or "views"
  double exponent = 0;                 ///< not finite: there is none
  std::vector<GrowthPoint> points;
};

struct Skipped {
  std::string technique, preset, scene, why;  ///< no preset: all presets; no scene: all scenes
};

/// What a time limit left out.
struct LeftOut {
  std::string technique, preset, variant;  ///< empty: all
  std::string scene, effect;
  /// "everything", "rounds", "ladder", "SSIM and FLIP", "own floor", "growth", "checks", "naive kernels"
  std::string what;
};

/// A figure from a paper's table, with ours.
struct PaperFigure {
  std::string table, row, column;
  Number ms, ratio, paper_ms, paper_ratio;
  std::string base;  ///< the row that the ratio is to
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

/// The frame with the largest error.
struct Worst {
  Number frame, rmse;
};

/// One technique with one preset on the frames of a shot.
struct SequenceRow {
  std::string technique, preset;
  bool temporal = false;  ///< accumulated over the frames
  Milliseconds ms;        ///< of one frame
  Number ratio_to_hbao_plus, rmse;
  Worst worst;
  Number ssim, flicker, new_rmse, old_rmse;
};

/// The frames of a shot (gloam bench --sequence).
struct Sequence {
  std::string shot, scene_class;
  std::vector<double> frames;  ///< their numbers
  Number width, height, radius, truth_rays, truth_noise, truth_change, comparable;
  std::string radius_from;
  std::vector<std::string> motion, made, reused;
  std::vector<SequenceRow> rows;
};

/// The frozen set that was measured on; the name is empty where there was none.
struct SetFacts {
  std::string name, part, hash;
  Number seed;
  bool empty() const { return name.empty(); }
};

/// How many of the hard cases that concern a technique it holds (gloam stress).
struct HeldCases {
  size_t held = 0, cases = 0;
};

struct Measurements {
  bool is_of_frames = true;  ///< not of a shot alone
  std::string device, cpu, driver, date, commit;
  std::string gloam;                 ///< the version; empty in older files
  std::vector<std::string> command;  ///< as given; empty in older files
  SetFacts set;
  Number cores, rounds, rays;
  std::optional<Peaks> peaks;  ///< those of the largest scene
  std::vector<Scene> scenes;   ///< every scene that a row names is here
  std::vector<Row> rows;       ///< measured by gloam
  std::vector<Row>
      submitted;  ///< of other methods (gloam score): errors, and no time that compares with those of `rows`
  std::vector<Growth> growth;
  std::vector<Skipped> skipped;
  std::vector<LeftOut> left_out;
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

/// The content of a bench.json with these measurements, without what pages add.
Json document_of(const Measurements& measurements);

/// A document as text with a key a line, and of a list of objects one object a line: lines that differ are rows that differ.
std::string text_of(const Json& document);

/// The bench.json that a path names: the file itself, or the one in the folder. Throws Error if there is neither.
std::filesystem::path measurements_file(const std::filesystem::path& folder_or_file);

/// As `read_measurements`, from a file of any name, which may hold only `converged`, `scales`, `planes` or a sequence.
Measurements read_measurements_file(const std::filesystem::path& file);

}  // namespace gloam::report
