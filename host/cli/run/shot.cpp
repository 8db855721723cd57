#include "cli/run/shot.h"

#include <algorithm>

#include "base/memory.h"
#include "base/page_pool.h"
#include "cli/flags/memory.h"
#include "cli/process/chunk_commands.h"
#include "cli/shot/memory.h"
#include "cli/shot/start.h"
#include "cli/shot/work.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/history.h"
#include "gloam/planes.h"
#include "sequence/chunks.h"
#include "sequence/history_chain.h"
#include "sequence/pipeline.h"

namespace gloam::cli {
namespace {

/// Whether each frame goes on from the one before.
bool is_temporal(const RunCommand& flags) {
  return flags.technique_flags.temporal || accumulates_by_itself(find_technique(flags.technique));
}

/// Throws UsageError for a technique, flags and names that do not go with a shot.
void check_flags(const RunCommand& flags) {
  const FrameArguments& frame = flags.frame;
  for (const std::string& file : {frame.frame, frame.other_eye}) {
    if (!file.empty() && !FramePattern::is_pattern(file))
      throw UsageError("{}: is one frame, and the other eye a shot; write both as patterns, such as L.####.exr", file);
  }
  if (!flags.picture.empty())
    throw UsageError("--picture {}: is made of one frame; leave it out, or run that frame alone", flags.picture);
  if (!frame.history.empty())
    throw UsageError("--history {}: goes with one frame; run one frame after another, each with the file of the one before",
                     frame.history);
  if (is_temporal(flags) && flags.shot.choice.missing == MissingFrames::hold)
    throw UsageError(
        "--missing hold: a frame that is held does not go on from the one before; skip missing frames, or "
        "leave out --temporal");
  if (flags.shot.warm_up > 0 && flags.shot.chunks > 0)
    throw UsageError("--warm-up {}: each chunk has its own; leave it out, or leave out --chunks", flags.shot.warm_up);
  if (flags.shot.warm_up > 0 && !is_temporal(flags))
    throw UsageError("--warm-up {}: no frame goes on from another; leave it out, or add --temporal",
                     flags.shot.warm_up);
  if (flags.run_flags.repeat > 1)
    throw UsageError("--repeat {}: times one frame; leave it out, or run one frame alone", flags.run_flags.repeat);
}

/// Prints a command a line, each for some of the frames. Any of them may be run again, anywhere where the files are.
void print_chunks(const RunCommand& flags, const ShotFiles& shot) {
  if (!flags.json.path.empty()) throw UsageError("--json {}: each chunk would write it; leave it out", flags.json.path);
  if (shot.cameras_are_in_order())
    throw UsageError(
        "--camera {}: lists cameras in the order of all frames, and a chunk has some of them; list them by number, as "
        "in {{\"frames\": {{\"1001\": ...}}}}",
        flags.frame_flags.camera);
  const auto print = [&](const std::vector<int>& chunk, size_t warm_up) {
    std::vector<std::string> more = {"--frames", frames_as_flag(chunk)};
    if (warm_up > 0) more.insert(more.end(), {"--warm-up", std::to_string(warm_up)});
    more.push_back("--resume");
    print_chunk(flags.repeated, more);
  };
  if (is_temporal(flags)) {
    for (const auto& [chunk, warm_up] : chunks_of_blocks(shot.numbers(), flags.shot.chunks)) print(chunk, warm_up);
  } else {
    for (const std::vector<int>& chunk : chunks_of(shot.numbers(), flags.shot.chunks)) print(chunk, 0);
  }
  end_of_chunks();
}

/// The first frame that can be planned stands for all. Throws UsageError for settings that no frame accepts, and Error if no
/// frame can be planned.
PlannedFrame first_planned(const ShotFiles& shot, const PlanRequest& request, bool carries_depth, bool has_composite) {
  std::optional<PlannedFrame> planned;
  first_that_can(shot, [&](const SequenceFrame& frame) {
    planned.emplace(planned_frame(shot.open(frame), request, carries_depth));
    if (has_composite) planned->colour.emplace(open_colour(shot.paths_of(frame), shot.options_for(frame)));
  });
  return std::move(*planned);
}

/// What a frame leaves for the next, while that takes it over.
unsigned long long bytes_of_history(const PlannedFrame& planned) {
  if (!planned.request.temporal) return 0;
  unsigned long long bytes = 0;
  for (const std::string& plane : planned.plan.inputs) {
    if (is_of_history(plane)) bytes += plane_kind(plane).components.size() * sizeof(float);
  }
  const Window window = planned.files.window();
  return 2 * bytes * size_t(window.width()) * size_t(window.height()) * planned.files.views().size();
}

ShotMemory memory_for(const RunCommand& flags, const PlannedFrame& first) {
  const Layout layout(first.files.window().width(), first.files.window().height());
  const unsigned long long beside = process_bytes_with_device + bytes_of_history(first) +
                                    bytes_beside_frame(first.plan, layout, first.files.views().size(), true);
  return shot_memory(first.files.name(), bytes_in_flight(first), beside, limit_of(flags.frame_flags, flags.shot.memory),
                     "ask for less (--outputs, --resolution half), for one view (--view), or allow more");
}

/// Opens the device and compiles while the first frames are decoded.
std::future<Device> start_device(const RunCommand& flags, const PlannedFrame& first, const RunOptions& options) {
  const Layout layout(first.files.window().width(), first.files.window().height());
  return std::async(std::launch::async, [flags = DeviceFlags(flags.run_flags), plan = first.plan, options, layout,
                                         views = first.files.views().size()] {
    Device device = flags.open();
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
  std::string history;
  for (const Turn& turn : turns) {
    const SequenceFrame& frame = shot.frames()[turn.frame];
    if (turn.begins) history.clear();
    try {
      FrameMaking making = making_of(settings, shot.open(frame));
      history = add_history_to(making, history);
      if (!turn.is_written) continue;
      const auto [path, why] = first_to_write_again(settings.outputs.of(frame.number), settings.writing, making);
      is_whole[turn.frame] = why.empty();
      if (!why.empty()) report.written_again(frame.number, path, why);
    } catch (const Error&) {
      // Told when the frame's turn comes. The next one begins anew.
      history.clear();
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

}  // namespace

void run_on_shot(const RunCommand& flags, const PlanRequest& alone) {
  check_flags(flags);
  const FrameOutputs named = outputs_of(flags);
  check(named, flags);
  const ShotOutputs outputs(named, flags.frame.frame);
  const ShotFiles shot(flags.frame, flags.frame_flags, flags.shot.choice);
  check_outputs(outputs.patterns(), shot, {{"--json", flags.json.file()}});
  const Carried carried{.depth = flags.shot.keep_depth && !flags.bare && !flags.out.empty(), .cameras = !flags.bare};
  PlanRequest given = alone;
  given.temporal = is_temporal(flags);
  PlannedFrame first = first_planned(shot, given, carried.depth, named.has_composite());
  keep_first_output(first, carried.depth);
  const OutputSettings writing = output_settings(flags, !flags.shot.as_float, first.request, first.plan);
  const std::vector<std::string> written = first.request.only_outputs;
  if (given.temporal) {
    first.request.only_outputs = with_planes_for_history(first.request.only_outputs, first.plan.technique);
    plan_again(first, carried.depth);
  }
  ShotSettings settings{.request = first.request,
                        .written = written,
                        .options = flags.run_flags.run_options(),
                        .writing = writing,
                        .carried = carried,
                        .outputs = outputs,
                        .resume = flags.shot.resume,
                        .version = version_with_kernels(GLOAM_VERSION),
                        .contents = flags.technique + flags.given};
  if (flags.shot.chunks > 0) return print_chunks(flags, shot);
  settings.display = first.files.files().front().display();
  const ShotMemory memory = memory_for(flags, first);
  settings.frame_bytes = memory.frame;
  const PageReuse reuse(memory.all - process_bytes_with_device);
  const size_t warm_up = std::min(size_t(flags.shot.warm_up), shot.frames().size());
  std::vector<int> numbers = shot.numbers();
  numbers.erase(numbers.begin(), numbers.begin() + std::ptrdiff_t(warm_up));
  const ShotStart start(outputs.patterns(), numbers);
  ShotReport report(numbers.size(), flags.json);
  const std::vector<Turn> turns = turns_for(shot, settings, warm_up, report);
  Pipeline* running = nullptr;
  ShotWork work(shot, settings, turns, start_device(flags, first, settings.options), report, [&] { running->stop(); });
  Pipeline pipeline(turns.size(), memory.size,
                    {[&](size_t i) { return work.decode(i); }, [&](size_t i) { return work.compute(i); },
                     [&](size_t i) { return work.write(i); }});
  running = &pipeline;
  pipeline.run();
  report.finish(fmt::format("{}", fmt::join(named.paths(), ", ")),
                fmt::format("{}{}", fmt::join(written, ", "), named.has_composite() ? ", composite" : ""));
}

}  // namespace gloam::cli
