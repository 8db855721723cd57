#include "cli/flags/memory.h"
#include "cli/process/chunk_commands.h"
#include "cli/run/command.h"
#include "cli/run/outputs.h"
#include "cli/shot/report.h"
#include "gloam/error.h"
#include "sequence/chunks.h"
#include "shot/run_step.h"

namespace gloam::cli {
namespace {

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
    throw UsageError(
        "--history {}: goes with one frame; run one frame after another, each with the file of the one before",
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
void print_chunks(const RunCommand& flags, const SequenceFiles& shot) {
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

}  // namespace

void run_on_shot(const RunCommand& flags, const PlanRequest& alone) {
  check_flags(flags);
  const FrameOutputs outputs = outputs_of(flags);
  check(outputs, flags);
  NamedPatterns patterns;
  RunSettings settings{
      .request = alone,
      .options = flags.run_flags.run_options(),
      .outputs = outputs_of_shot(outputs, flags.frame.frame, patterns),
      .carried = {.depth = flags.shot.keep_depth && !flags.bare && !flags.out.empty(), .cameras = !flags.bare},
      .contents = flags.technique + flags.given};
  settings.request.temporal = is_temporal(flags);
  const SequenceFiles shot = shot_files(flags.frame, flags.frame_flags, flags.shot.choice);
  check_outputs(patterns, shot, {{"--json", flags.json.file()}});
  PlannedFrame first = first_planned(shot, settings);
  settings.writing = output_settings(flags, first.request, first.plan);
  if (flags.shot.chunks > 0) return print_chunks(flags, shot);
  const size_t frames = shot.frames().size(), warm_up = size_t(flags.shot.warm_up);
  if (warm_up >= frames)
    throw UsageError("--warm-up {}: there are {} frames, and none would be written; give more frames", warm_up, frames);
  ShotReport report(frames - warm_up, flags.json);
  RunStep step(shot, settings, std::move(first), report);
  const ShotMemory memory =
      step.memory(limit_of(flags.frame_flags, flags.shot.memory),
                  "ask for less (--outputs, --resolution half), for one view (--view), or allow more");
  ShotRun run(shot, step,
              {.version = version_with_kernels(GLOAM_VERSION),
               .resumes = flags.shot.resume,
               .goes_on = settings.request.temporal,
               .warm_up = warm_up,
               .size = step.size(),
               .memory = memory},
              report);
  say_how_to_go_on();
  step.start([&] { return std::make_shared<Device>(flags.run_flags.open()); });
  run.run();
  report.finish(fmt::format("{}", fmt::join(paths_of(outputs), ", ")),
                fmt::format("{}{}", fmt::join(step.written(), ", "), outputs.has_composite() ? ", composite" : ""));
}

}  // namespace gloam::cli
