#include "cli/bench/sequence.h"

#include <algorithm>

#include "cli/bench/file.h"
#include "cli/bench/print.h"
#include "cli/flags/memory.h"
#include "cli/shot/shot.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "measure/sequence_document.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

/// Frames that are measured without --frames.
constexpr size_t default_frames = 10;

/// A shot of a built-in scene.
struct BuiltinShot {
  const SceneRecipe* scene = nullptr;
  const ShotRecipe* shot = nullptr;
  std::string name() const { return scene->name + ":" + shot->name; }
};

std::vector<BuiltinShot> builtin_shots() {
  std::vector<BuiltinShot> shots;
  for (const SceneRecipe& scene : builtin_scenes()) {
    for (const ShotRecipe& shot : scene.shots) shots.push_back({&scene, &shot});
  }
  return shots;
}

/// By "gallery:walk", or by "walk" where one scene alone has a shot of this name.
BuiltinShot find_shot(const std::string& name) {
  std::vector<BuiltinShot> named;
  std::vector<std::string> known, alone;
  for (const BuiltinShot& shot : builtin_shots()) {
    known.push_back(shot.name());
    alone.push_back(shot.shot->name);
    if (name == shot.name() || name == shot.shot->name) named.push_back(shot);
  }
  if (named.size() == 1) return named.front();
  std::error_code unknown;
  if (std::filesystem::exists(name, unknown))
    throw UsageError(
        "--sequence {}: is one file; --frame measures one frame, and a pattern such as shot.####.exr a shot", name);
  std::string nearest = suggestion(name, known);
  if (nearest.empty()) nearest = suggestion(name, alone);
  throw UsageError("--sequence {}: is no built-in shot{}; there are {}, and patterns such as shot.####.exr", name,
                   nearest, enumerate(known));
}

/// The frames to measure of `count`.
std::vector<int> frames_of(const FrameChoice& choice, const BuiltinShot& shot) {
  std::vector<int> frames;
  for (int frame = 1; frame <= int(default_frames) && frame <= shot.shot->frames; ++frame) frames.push_back(frame);
  if (choice.frames) frames = *choice.frames;
  for (const int frame : {frames.front(), frames.back()}) {
    if (frame < 1 || frame > shot.shot->frames)
      throw UsageError("--frames {}: {} has frames 1 to {}", frame, shot.name(), shot.shot->frames);
  }
  return frames;
}

void check_count(const std::vector<int>& frames) {
  if (frames.size() < 2)
    throw UsageError("--frames {}: is one frame, and flicker is between two; name more, or measure it by --frame",
                     frames_in_words(frames));
}

// --- Built-in shots

Scene scene_at(const BuiltinShot& shot, int frame) {
  Settings settings;
  if (shot.shot->moves_objects) settings.emplace_back("time", fmt::format("{}", seconds_of_frame(frame)));
  return load_scene(shot.scene->name, settings);
}

/// Captures and traces a frame, or reads what an earlier run kept.
Subject subject_of(const BuiltinShot& shot, int frame, const MeasureOptions& options, SceneOptions making) {
  const int before = std::max(frame - 1, 1);
  making.in_sequence = InSequence{shot.shot->camera(seconds_of_frame(before)), nullptr, frame};
  if (shot.shot->moves_objects && before != frame)
    making.in_sequence->scene_before = std::make_shared<const Scene>(scene_at(shot, before));
  Scene scene = scene_at(shot, frame);
  scene.cameras.front() = shot.shot->camera(seconds_of_frame(frame));
  return scene_subject(fmt::format("{}_{}_{:04}", shot.scene->name, shot.shot->name, frame), shot.scene->kind,
                       std::move(scene), "ao", options.techniques, making, note);
}

void add_builtin(MeasuredSequence& sequence, const BuiltinShot& shot, const std::vector<int>& frames,
                 const MeasureOptions& options, const SceneOptions& making) {
  sequence.name = shot.name();
  sequence.scene_class = shot.scene->kind;
  for (const int frame : frames) add_frame(sequence, frame, subject_of(shot, frame, options, making));
}

// --- Own frames

std::vector<FramePattern> patterns_of(const SequenceBenchFlags& flags) {
  std::vector<FramePattern> patterns = {FramePattern(flags.sequence, "--sequence")};
  for (const std::string& truth : flags.truths) {
    if (!FramePattern::is_pattern(truth))
      throw UsageError("--truth {}: is one file, and {} a shot; write both as patterns, such as truth.####.exr", truth,
                       flags.sequence);
    patterns.emplace_back(truth, "--truth");
  }
  return patterns;
}

std::vector<SequenceFrame> frames_of(const SequenceBenchFlags& flags, const SequenceFiles& shot) {
  std::vector<SequenceFrame> frames = shot.frames();
  if (flags.choice.frames || frames.size() <= default_frames) return frames;
  note({fmt::format("the first {} of {} frames are measured; --frames says which", default_frames, frames.size())});
  frames.resize(default_frames);
  return frames;
}

/// Throws Error if the frames together take more memory than there is. `first`: of `count` frames alike.
void check_memory(const SequenceBenchFlags& flags, const MeasuredFrame& first, size_t count) {
  unsigned long long bytes = 0;
  const unsigned long long channel = Layout(first.frame.width(), first.frame.height()).bytes();
  for (const View& view : first.frame.views) {
    for (const auto& [name, plane] : view.planes) bytes += plane.channels.size() * channel;
    bytes += channel;  // the truth
  }
  planned_memory(flags.frame_flags, flags.sequence, process_bytes_with_device + bytes * count,
                 "measure fewer frames (--frames)");
}

/// Names the frame in an error of what is done on it.
Subject naming_frame(int number, const std::function<Subject()>& made) {
  try {
    return made();
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error("frame {}: {}", number, error.what());
  }
}

void add_own(MeasuredSequence& sequence, const SequenceBenchFlags& flags, const SequenceFiles& shot,
             const MeasureOptions& options, SceneOptions making) {
  sequence.name = flags.sequence;
  sequence.scene_class = "own";
  const std::vector<SequenceFrame> frames = frames_of(flags, shot);
  for (const SequenceFrame& frame : frames) {
    const std::vector<std::string> paths = shot.paths_of(frame);
    FrameFlags reading = flags.frame_flags;
    reading.camera = shot.camera_of(frame);
    making.in_sequence = InSequence{.camera_before = {}, .scene_before = nullptr, .seed = frame.number};
    show_status(fmt::format("frame {}", frame.number), double(sequence.frames.size()) / double(frames.size()));
    add_frame(sequence, frame.number, naming_frame(frame.number, [&] {
                return own_subject(own_frame(paths.front(), reading, {paths.begin() + 1, paths.end()}), "ao",
                                   options.techniques, making, note);
              }));
    if (sequence.frames.size() > 1) continue;
    check_memory(flags, sequence.frames.front(), frames.size());
    making.radius = sequence.radius.value;  // the same in all frames
  }
}

// --- Techniques

/// Leaves out techniques over further layers, which take several times as long, where the user does not name them.
void leave_out_layers(MeasureOptions& options, std::vector<Skipped>& skipped, const std::string& sequence) {
  for (const Technique* technique : options.techniques) {
    if (reads_layers(*technique))
      skipped.push_back({technique->name, "", sequence, "reads further layers: measured where --techniques names it"});
  }
  std::erase_if(options.techniques, [](const Technique* technique) { return reads_layers(*technique); });
}

void print(const MeasuredSequence& sequence, const SequenceMeasurement& measured, const DeviceInfo& device) {
  fmt::print("{}, {} ({})\n", cpu_model(), printable(device.name), printable(device.platform));
  fmt::print(
      "ms: kernels of one frame, median over the frames; /hbao+: over HBAO+ medium on the same frame.\n"
      "RMSE, SSIM: mean over the frames; flicker: of the error, from frame to frame (docs/sequences.md).\n");
  cli::print(table_of_sequence(sequence, measured));
  print_skipped(measured.skipped);
}

}  // namespace

void check(const SequenceBenchFlags& flags) {
  if (FramePattern::is_pattern(flags.sequence)) {
    patterns_of(flags);
    if (flags.has_size)
      throw UsageError("--size: is for built-in shots, and {} has frames of its own; leave it out", flags.sequence);
    if (flags.choice.frames) check_count(*flags.choice.frames);
    return;
  }
  const BuiltinShot shot = find_shot(flags.sequence);
  if (!flags.truths.empty())
    throw UsageError("--truth {}: the truths of the built-in shot {} are traced; leave it out", flags.truths.front(),
                     shot.name());
  if (!flags.reading.empty())
    throw UsageError("{}: says how files are read, and {} is a built-in shot; leave it out", flags.reading,
                     shot.name());
  if (flags.choice.missing)
    throw UsageError("--missing: is for files, and {} is a built-in shot; leave it out", shot.name());
  check_count(frames_of(flags.choice, shot));
}

namespace {

/// Fits options to frames of a sequence. Adds to `skipped` the techniques that are left out.
void fit(MeasureOptions& options, SceneOptions& making, const SequenceBenchFlags& flags,
         std::vector<Skipped>& skipped) {
  if (!flags.names_techniques) leave_out_layers(options, skipped, flags.sequence);
  making.more_planes = {"motion"};
  const bool has_layers = std::any_of(options.techniques.begin(), options.techniques.end(),
                                      [](const Technique* technique) { return reads_layers(*technique); });
  if (!has_layers) making.layers = 0;
}

SequenceMeasurement measured_on(MeasuredSequence& sequence, const MeasureOptions& options,
                                const std::vector<Skipped>& skipped, Device& device) {
  SequenceMeasurement measured = measure_sequence(sequence, options, device);
  erase_status();
  if (measured.rows.empty())
    throw Error("nothing could be measured: {} {}", measured.skipped.back().technique, measured.skipped.back().why);
  measured.skipped.insert(measured.skipped.end(), skipped.begin(), skipped.end());
  return measured;
}

/// The user's frames; throws UsageError or Error where they cannot be measured.
SequenceFiles own_frames(const SequenceBenchFlags& flags) {
  SequenceFiles shot = shot_files(patterns_of(flags), flags.frame_flags, flags.choice);
  if (!flags.frame_flags.camera.empty() && shot.camera_of(shot.frames().front()).empty())
    throw UsageError("--camera {}: lists cameras; write one file for each frame, as in camera.####.json",
                     flags.frame_flags.camera);
  check_count(shot.numbers());
  return shot;
}

void read_own(MeasuredSequence& sequence, const SequenceBenchFlags& flags, const MeasureOptions& options,
              const SceneOptions& making, const std::vector<NamedPath>& outputs) {
  const SequenceFiles shot = own_frames(flags);
  make_output_folder(making.folder);
  check_outputs({}, shot, outputs);
  add_own(sequence, flags, shot, options, making);
}

}  // namespace

MeasuredShot measure_own_shot(const SequenceBenchFlags& flags, MeasureOptions options, SceneOptions making,
                              const std::vector<Skipped>& skipped, Device& device,
                              const std::vector<NamedPath>& outputs) {
  std::vector<Skipped> left_out = skipped;
  fit(options, making, flags, left_out);
  MeasuredShot shot;
  read_own(shot.sequence, flags, options, making, outputs);
  shot.measured = measured_on(shot.sequence, options, left_out, device);
  return shot;
}

void bench_sequence(const SequenceBenchFlags& flags, const MeasureOptions& given, const SceneOptions& scene,
                    const std::vector<Skipped>& skipped, Device& device, const JsonFlag& json) {
  const std::vector<NamedPath> outputs = {{"--json", json.file()}};
  const bool is_own = FramePattern::is_pattern(flags.sequence);
  if (is_own) own_frames(flags);  // before the folder is made
  make_output_folder(flags.folder);
  check_paths({}, outputs, {{"-o", (std::filesystem::path(flags.folder) / "bench.json").string()}});
  const BenchFile written(flags.folder);
  MeasuredShot shot;
  if (is_own) {
    shot = measure_own_shot(flags, given, scene, skipped, device, outputs);
  } else {
    MeasureOptions options = given;
    SceneOptions making = scene;
    std::vector<Skipped> left_out = skipped;
    fit(options, making, flags, left_out);
    const BuiltinShot builtin = find_shot(flags.sequence);
    make_output_folder(making.folder);
    add_builtin(shot.sequence, builtin, frames_of(flags.choice, builtin), options, making);
    shot.measured = measured_on(shot.sequence, options, left_out, device);
  }
  const Json document = report::document_of(results_of(shot.sequence, shot.measured, device.info()));
  written.write(document);
  json.write(document);
  if (json.only_json()) return;
  print(shot.sequence, shot.measured, device.info());
  fmt::print("wrote {}\n", printable(written.path().string()));
}

}  // namespace gloam::cli
