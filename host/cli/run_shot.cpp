#include "cli/run_shot.h"

#include <algorithm>
#include <thread>

#include "base/files.h"
#include "base/memory.h"
#include "base/page_pool.h"
#include "cli/memory.h"
#include "cli/shot_work.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/history.h"
#include "gloam/planes.h"
#include "sequence/chunks.h"
#include "sequence/frame_locks.h"
#include "sequence/pipeline.h"

namespace gloam::cli {
namespace {

using Bytes = unsigned long long;

/// Whether each frame goes on from the one before.
bool is_temporal(const RunCommand& flags) {
  return flags.technique_flags.temporal || contains(find_technique(flags.technique).reads, "history");
}

/// Throws UsageError for a technique, flags and names that do not go with a shot.
void check_flags(const RunCommand& flags) {
  const FrameArguments& frame = flags.frame;
  for (const std::string& file : {frame.frame, frame.other_eye}) {
    if (!file.empty() && !FramePattern::is_pattern(file))
      throw UsageError("{}: is one frame, and the other eye a shot; write both as patterns, such as L.####.exr", file);
  }
  check_frame_name(flags.out, "-o");
  if (!FramePattern::is_pattern(flags.out))
    throw UsageError("-o {}: is one file, and {} a shot; write both as patterns, such as ao.####.exr", flags.out,
                     frame.frame);
  if (!flags.picture.empty())
    throw UsageError("--picture {}: is made of one frame; leave it out, or run that frame alone", flags.picture);
  if (!frame.history.empty())
    throw UsageError("--history {}: is of one frame; run frame after frame, each with the file of the one before",
                     frame.history);
  if (is_temporal(flags) && flags.shot.choice.missing == MissingFrames::hold)
    throw UsageError(
        "--missing hold: a frame that is held does not go on from the one before; skip missing frames, or "
        "leave out --temporal");
  if (flags.shot.warm_up > 0 && !is_temporal(flags))
    throw UsageError("--warm-up {}: no frame goes on from another; leave it out, or add --temporal",
                     flags.shot.warm_up);
  if (flags.run_flags.repeat > 1)
    throw UsageError("--repeat {}: times one frame; leave it out, or run one frame alone", flags.run_flags.repeat);
}

/// The path of this program.
std::string program_path() {
  std::error_code unknown;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return unknown ? "gloam" : path.string();
}

/// Prints a command a line, each for some of the frames. Any of them may be run again, anywhere where the files are.
void print_chunks(const RunCommand& flags, const ShotFiles& shot) {
  if (!flags.json.path.empty()) throw UsageError("--json {}: each chunk would write it; leave it out", flags.json.path);
  if (shot.cameras_are_in_order())
    throw UsageError(
        "--camera {}: lists cameras in the order of all frames, and a chunk has some of them; list them by number, as "
        "in {{\"frames\": {{\"1001\": ...}}}}",
        flags.frame_flags.camera);
  std::string words;
  for (const std::string& word : flags.repeated) words += " " + quoted_for_shell(word);
  const std::string folder = quoted_for_shell(std::filesystem::current_path().string());
  const auto print = [&](const std::vector<int>& chunk, const std::string& more) {
    fmt::print("cd {} && {}{} --frames {}{} --resume\n", folder, quoted_for_shell(program_path()), words,
               frames_as_flag(chunk), more);
  };
  if (is_temporal(flags)) {
    for (const auto& [chunk, warm_up] : chunks_of_blocks(shot.numbers(), flags.shot.chunks))
      print(chunk, warm_up == 0 ? "" : fmt::format(" --warm-up {}", warm_up));
  } else {
    for (const std::vector<int>& chunk : chunks_of(shot.numbers(), flags.shot.chunks)) print(chunk, "");
  }
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
}

/// The first frame that can be planned stands for all. Throws UsageError for settings that no frame accepts, and Error if no
/// frame can be planned.
PlannedFrame first_planned(const ShotFiles& shot, const PlanRequest& request, bool carries_depth) {
  std::string first_error;
  for (const SequenceFrame& frame : shot.frames()) {
    try {
      return planned_frame(shot.open(frame), request, carries_depth);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  if (shot.frames().size() == 1) throw Error("{}", first_error);
  throw Error("none of the {} frames can be computed; the first: {}", shot.frames().size(), first_error);
}

/// By default the first output alone, with the extras asked for.
void ask_for_first_output(PlanRequest& request, const Plan& plan) {
  if (!request.only.empty()) return;
  request.only = {plan.outputs.front()};
  add_new(request.only, request.with);
}

/// One frame in each thread's hands, and one that waits before each step.
PipelineSize wanted_size() {
  PipelineSize size;
  size.decoders = size.writers = std::clamp(std::thread::hardware_concurrency(), 1u, 2u);
  size.in_flight = size.decoders + size.writers + 3;
  return size;
}

/// The largest pipeline within the limit.
struct ShotMemory {
  PipelineSize size;
  Bytes frame, all;  ///< most that a frame in flight may take; the whole process
};

/// What a frame leaves for the next, while that takes it over.
Bytes bytes_of_history(const PlannedFrame& planned) {
  if (!planned.request.temporal) return 0;
  Bytes bytes = 0;
  for (const std::string& plane : planned.plan.inputs) {
    if (contains(history_planes(), plane)) bytes += plane_kind(plane).components.size() * sizeof(float);
  }
  const Window window = planned.files.window();
  return 2 * bytes * Bytes(window.width()) * Bytes(window.height()) * planned.files.views().size();
}

ShotMemory memory_for(const RunCommand& flags, const PlannedFrame& first) {
  const Layout layout(first.files.window().width(), first.files.window().height());
  const Bytes own = bytes_in_flight(first);
  const Bytes beside = process_bytes_with_device + bytes_of_history(first) +
                       bytes_beside_frame(first.plan, layout, first.files.views().size(), true);
  const MemoryLimit limit = limit_of(flags.frame_flags, flags.shot.memory);
  if (limit.bytes < beside + own)
    throw Error(
        "{}: one frame of the shot would take about {} of memory, and {}; ask for less (--outputs, --resolution "
        "half), for one view (--view), or allow more",
        first.files.name(), memory_in_words(beside + own), limit.words);
  ShotMemory memory{wanted_size(), 0, 0};
  memory.size.in_flight = size_t(std::min<Bytes>(memory.size.in_flight, (limit.bytes - beside) / own));
  memory.size.decoders = std::min(memory.size.decoders, memory.size.in_flight);
  memory.size.writers = std::min(memory.size.writers, memory.size.in_flight);
  memory.frame = (limit.bytes - beside) / memory.size.in_flight;
  memory.all = beside + memory.size.in_flight * own;
  return memory;
}

/// Opens the device and compiles while the first frames are decoded.
std::future<Device> start_device(const RunCommand& flags, const PlannedFrame& first, const RunOptions& options) {
  const Layout layout(first.files.window().width(), first.files.window().height());
  return std::async(std::launch::async, [name = flags.run_flags.device, plan = first.plan, options, layout,
                                         views = first.files.views().size()] {
    Device device(name);
    check(plan, layout, views, device, options);
    prepare(plan, device, options);
    return device;
  });
}

/// The frames to compute, in order. Tells of those that are left alone.
std::vector<Turn> turns_for(const ShotFiles& shot, const ShotSettings& settings, size_t warm_up, ShotReport& report) {
  const std::vector<int> numbers = shot.numbers();
  std::vector<Turn> turns;
  if (!settings.request.temporal) {
    for (size_t i = 0; i < numbers.size(); ++i) turns.push_back({.frame = i, .begins = true});
    return turns;
  }
  if (warm_up >= numbers.size())
    throw UsageError("--warm-up {}: there are {} frames, and none would be written; give more frames", warm_up,
                     numbers.size());
  std::vector<bool> is_whole(numbers.size(), false);
  turns = turns_of(numbers, warm_up, is_whole);
  if (!settings.resume) return turns;
  for (const Turn& turn : turns) {
    if (!turn.is_written) continue;
    const SequenceFrame& frame = shot.frames()[turn.frame];
    const std::filesystem::path output = settings.output.path_of(frame.number);
    try {
      const std::string why = why_again(output, making_of(settings, shot.open(frame), turn));
      is_whole[turn.frame] = why.empty();
      if (!why.empty() && std::filesystem::exists(output)) report.written_again(frame.number, why);
    } catch (const Error&) {
      // Told when the frame's turn comes.
    }
  }
  turns = turns_of(numbers, warm_up, is_whole);
  std::vector<bool> is_left(numbers.size(), true);
  for (const Turn& turn : turns) {
    if (turn.is_written) is_left[turn.frame] = false;
  }
  for (size_t i = warm_up; i < numbers.size(); ++i) {
    if (is_left[i]) report.skipped(numbers[i]);
  }
  return turns;
}

/// Asks for the planes from which the next frame's history is made, too.
void ask_for_history(PlanRequest& request, const Plan& plan) {
  for (const std::string& name : planes_for_history()) {
    if (contains(outputs_of(find_technique(plan.technique)), name)) add_new(request.only, name);
  }
}

}  // namespace

void run_on_shot(const RunCommand& flags, const PlanRequest& given) {
  check_flags(flags);
  const FramePattern output(flags.out, "-o");
  const ShotFiles shot(flags.frame, flags.frame_flags, flags.shot.choice);
  check_outputs(output, shot, {{"--json", flags.json.file()}});
  ShotSettings settings{.request = given,
                        .options = flags.run_flags.run_options(),
                        .writing = {!flags.shot.as_float, flags.compression},
                        .carried = {.depth = flags.shot.keep_depth && !flags.bare, .cameras = !flags.bare},
                        .output = output,
                        .resume = flags.shot.resume,
                        .version = version_with_kernels(GLOAM_VERSION),
                        .contents = flags.technique + flags.given};
  settings.request.temporal = is_temporal(flags);
  const Plan plan = first_planned(shot, settings.request, settings.carried.depth).plan;
  ask_for_first_output(settings.request, plan);
  settings.written = settings.request.only;
  if (settings.request.temporal) ask_for_history(settings.request, plan);
  const PlannedFrame first = first_planned(shot, settings.request, settings.carried.depth);
  if (flags.shot.chunks > 0) return print_chunks(flags, shot);
  settings.display = first.files.files().front().display();
  const ShotMemory memory = memory_for(flags, first);
  settings.frame_bytes = memory.frame;
  const PageReuse reuse(memory.all - process_bytes_with_device);
  std::vector<int> numbers = shot.numbers();
  numbers.erase(numbers.begin(), numbers.begin() + std::min(flags.shot.warm_up, int(numbers.size())));
  const FrameLocks locks(output, numbers);
  remove_leftovers(output.folder());
  say_on_interruption("frames that were written are whole; the same command with --resume goes on");
  const size_t warm_up = size_t(flags.shot.warm_up);
  ShotReport report(shot.frames().size() - std::min(warm_up, shot.frames().size()), flags.json);
  const std::vector<Turn> turns = turns_for(shot, settings, warm_up, report);
  Pipeline* running = nullptr;
  ShotWork work(shot, settings, turns, start_device(flags, first, settings.options), report, [&] { running->stop(); });
  Pipeline pipeline(turns.size(), memory.size,
                    {[&](size_t i) { return work.decode(i); }, [&](size_t i) { return work.compute(i); },
                     [&](size_t i) { return work.write(i); }});
  running = &pipeline;
  pipeline.run();
  report.finish(flags.out, fmt::format("{}", fmt::join(settings.written, ", ")));
}

}  // namespace gloam::cli
