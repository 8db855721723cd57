#include "cli/run_shot.h"

#include <algorithm>

#include "base/memory.h"
#include "base/page_pool.h"
#include "cli/memory.h"
#include "cli/shot_memory.h"
#include "cli/shot_start.h"
#include "cli/shot_work.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "sequence/chunks.h"
#include "sequence/pipeline.h"

namespace gloam::cli {
namespace {

/// Throws UsageError for a technique, flags and names that do not go with a shot.
void check_flags(const RunCommand& flags) {
  if (contains(find_technique(flags.technique).reads, "history"))
    throw UsageError(
        "{}: takes over the frame before, and a shot's frames are computed by themselves; run frame after frame, "
        "each with --history",
        flags.technique);
  const FrameArguments& frame = flags.frame;
  for (const std::string& file : {frame.frame, frame.other_eye}) {
    if (!file.empty() && !FramePattern::is_pattern(file))
      throw UsageError("{}: is one frame, and the other eye a shot; write both as patterns, such as L.####.exr", file);
  }
  if (!flags.picture.empty())
    throw UsageError("--picture {}: is made of one frame; leave it out, or run that frame alone", flags.picture);
  if (!frame.history.empty())
    throw UsageError("--history {}: is of one frame; run frame after frame, each with the file of the one before",
                     frame.history);
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
  for (const std::vector<int>& chunk : chunks_of(shot.numbers(), flags.shot.chunks))
    fmt::print("cd {} && {}{} --frames {} --resume\n", folder, quoted_for_shell(program_path()), words,
               frames_as_flag(chunk));
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
}

/// The first frame that can be planned stands for all. Throws UsageError for settings that no frame accepts, and Error if no
/// frame can be planned.
PlannedFrame first_planned(const ShotFiles& shot, const PlanRequest& request, bool carries_depth, bool has_composite) {
  std::string first_error;
  for (const SequenceFrame& frame : shot.frames()) {
    try {
      PlannedFrame planned = planned_frame(shot.open(frame), request, carries_depth);
      if (has_composite) planned.colour.emplace(open_colour(shot.paths_of(frame), shot.options_for(frame)));
      return planned;
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  throw none_of_shot(shot, first_error);
}

ShotMemory memory_for(const RunCommand& flags, const PlannedFrame& first) {
  const Layout layout(first.files.window().width(), first.files.window().height());
  const unsigned long long beside =
      process_bytes_with_device + bytes_beside_frame(first.plan, layout, first.files.views().size(), true);
  return shot_memory(first.files.name(), bytes_in_flight(first), beside, limit_of(flags.frame_flags, flags.shot.memory),
                     "ask for less (--outputs, --resolution half), for one view (--view), or allow more");
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

}  // namespace

void run_on_shot(const RunCommand& flags, const PlanRequest& given) {
  check_flags(flags);
  const FrameOutputs named = outputs_of(flags);
  check(named, flags);
  const ShotOutputs outputs(named, flags.frame.frame);
  const ShotFiles shot(flags.frame, flags.frame_flags, flags.shot.choice);
  check_outputs(outputs.patterns(), shot, {{"--json", flags.json.file()}});
  const Carried carried{.depth = flags.shot.keep_depth && !flags.bare && !flags.out.empty(), .cameras = !flags.bare};
  PlannedFrame first = first_planned(shot, given, carried.depth, named.has_composite());
  keep_first_output(first, carried.depth);
  ShotSettings settings{.request = first.request,
                        .options = flags.run_flags.run_options(),
                        .writing = output_settings(flags, !flags.shot.as_float, first.request, first.plan),
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
  const ShotStart start(outputs.patterns(), shot.numbers());
  ShotReport report(shot.frames().size(), flags.json);
  Pipeline* running = nullptr;
  ShotWork work(shot, settings, start_device(flags, first, settings.options), report, [&] { running->stop(); });
  Pipeline pipeline(shot.frames().size(), memory.size,
                    {[&](size_t i) { return work.decode(i); }, [&](size_t i) { return work.compute(i); },
                     [&](size_t i) { return work.write(i); }});
  running = &pipeline;
  pipeline.run();
  report.finish(fmt::format("{}", fmt::join(named.paths(), ", ")),
                fmt::format("{}", fmt::join(first.plan.outputs, ", ")));
}

}  // namespace gloam::cli
