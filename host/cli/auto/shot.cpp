#include "cli/shot/shot.h"

#include <algorithm>
#include <memory>

#include "cli/auto/command.h"
#include "cli/flags/memory.h"
#include "cli/shot/report.h"
#include "gloam/error.h"
#include "shot/auto_step.h"

namespace gloam::cli {
namespace {

void check_flags(const AutoCommand& flags) {
  if (!flags.explain.empty())
    throw UsageError("--explain {}: is a picture of one frame; leave it out, or explain that frame alone",
                     flags.explain);
  if (flags.measure) throw UsageError("--measure: times one frame; leave it out, or measure that frame alone");
  if (flags.mask == MaskUse::measured)
    throw UsageError(
        "--mask measured: times one frame, and masks that come and go would flicker; a shot takes always or never");
  if (flags.run_flags.repeat > 1)
    throw UsageError("--repeat {}: times one frame; leave it out, or run one frame alone", flags.run_flags.repeat);
  if (!flags.out.empty() && !FramePattern::is_pattern(flags.out))
    throw UsageError("-o {}: is one file, and {} a shot; write both as patterns, such as out.####.exr", flags.out,
                     flags.frame.frame);
}

/// Of results made without planes of the frames, by which `--resume` tells them from others: " without color".
std::string left_out_in_words(const std::vector<Unfit>& unfit) {
  std::vector<std::string> planes;
  for (const Unfit& each : unfit) planes.push_back(each.plane);
  return planes.empty() ? "" : " without " + enumerate(planes);
}

FramePattern composite_pattern(const AutoCommand& flags) {
  if (!FramePattern::is_pattern(flags.composite.path))
    throw UsageError("--composite {}: is one file, and {} a shot; write both as patterns, such as picture.####.exr",
                     flags.composite.path, flags.frame.frame);
  return FramePattern(flags.composite.path, "--composite");
}

/// The first frame that can be planned and read stands for all: it gives the radius.
struct FirstFrame {
  AutoFrame planned;
  Radius radius;
  std::optional<CompositeSource> source;
  AutoPurpose purpose;
  int number = 0;
};

std::vector<const Technique*> techniques_of(const std::vector<Candidate>& candidates) {
  std::vector<const Technique*> techniques;
  for (const Candidate& candidate : candidates) techniques.push_back(candidate.technique);
  return techniques;
}

/// Tells what the first frame leaves out of all: no later frame reads its unfit planes, so none would tell of them. `expected`: the techniques
/// of the effects that were possible before its planes were judged.
void note_left_out(const AutoFrame& first, const std::vector<std::string>& assumed,
                   const std::vector<const Technique*>& expected, int number) {
  for (const std::string& text : assumed)
    if (!unfit_planes({text}).empty()) note({note_in_shot(text, first.unfit, number)});
  for (const Outcome& outcome : first.candidates.impossible) {
    const EffectChoice& effect = outcome.decision.effect;
    if (std::find(expected.begin(), expected.end(), effect.technique) != expected.end())
      note({fmt::format("{}: in no frame; {}", effect.technique->effect.name, effect.why)});
  }
}

FirstFrame first_frame(const SequenceFiles& shot, const PlanRequest& asked, const AutoCommand& flags) {
  std::optional<FirstFrame> first;
  first_that_can(shot, [&](const SequenceFrame& frame) {
    FrameFiles files = shot.open(frame);
    std::vector<std::string> notes;
    const AutoPurpose purpose{false, flags.goal || !flags.composite.path.empty(),
                              compose_options(flags.composite.light, files, notes)};
    AutoFrame planned = planned_auto(std::move(files), asked, purpose);
    check_has_depth(planned, flags.out);
    const std::vector<const Technique*> expected = techniques_of(planned.candidates.possible);
    const Frame read = read_and_judge(planned, asked, purpose);
    check_goal(flags.goal, planned);
    const Radius radius = default_radius(read, stated_radius(planned.files));
    if (flags.goal && flags.composite.path.empty()) note(notes);
    auto source = open_composite(flags.composite.asked(), shot.paths_of(frame), shot.options_for(frame));
    leave_out(source, planned.unfit);
    note_left_out(planned, read.assumed, expected, frame.number);
    first.emplace(FirstFrame{std::move(planned), radius, std::move(source), purpose, frame.number});
  });
  return std::move(*first);
}

}  // namespace

void run_auto_on_shot(const AutoCommand& flags) {
  check_flags(flags);
  NamedPatterns outputs;
  if (!flags.out.empty()) outputs.emplace_back("-o", FramePattern(flags.out, "-o"));
  if (!flags.composite.path.empty()) outputs.emplace_back("--composite", composite_pattern(flags));
  const SequenceFiles shot = shot_files(flags.frame, flags.frame_flags, flags.shot.choice);
  check_outputs(outputs, shot, {{"--json", flags.json.file()}});
  const PlanRequest asked = flags.technique_flags.request({});
  FirstFrame first = first_frame(shot, asked, flags);
  AutoShotSettings settings{.asked = asked,
                            .computing = {.mask = flags.mask.value_or(MaskUse::never),
                                          .purpose = first.purpose,
                                          .radius_from = first.radius.from,
                                          .goal = flags.goal,
                                          .measuring = progress_bar()},
                            .radius = first.radius.value,
                            .options = flags.run_flags.run_options(),
                            .writing = {!flags.shot.as_float, flags.compression, {}, true, flags.shot.keep_margin},
                            .output = flags.out.empty() ? std::nullopt : std::optional(outputs.front().second),
                            .composite = flags.composite.asked(),
                            .keeps_depth = flags.shot.keep_depth,
                            .unfit = first.planned.unfit,
                            .decider = first.number,
                            .contents = fmt::format("auto{} radius {}{}", flags.given, first.radius.value,
                                                    left_out_in_words(first.planned.unfit))};
  if (!flags.composite.path.empty()) settings.composite_output = outputs.back().second;
  const ShotMemory memory =
      shot_memory(first.planned.files.name(), bytes_in_flight(first.planned, first.source),
                  bytes_of_auto(first.planned, true), limit_of(flags.frame_flags, flags.shot.memory),
                  "ask for --resolution half, for one view (--view), or allow more");
  ShotReport report(shot.frames().size(), flags.json);
  Device device = flags.run_flags.open();
  AutoStep step(shot, settings, device, report);
  ShotRun run(shot, step,
              {.version = version_with_kernels(GLOAM_VERSION),
               .resumes = flags.shot.resume,
               .size = first.planned.files.files().front().display(),
               .memory = memory},
              report);
  say_how_to_go_on();
  step.decide_on(first.planned);
  run.run();
  note(step.tally().in_words());
  std::vector<std::string> files, what;
  if (settings.output) files.push_back(flags.out), what.emplace_back("effects");
  if (settings.composite_output) files.push_back(flags.composite.path), what.emplace_back("composite");
  report.finish(fmt::format("{}", fmt::join(files, ", ")), fmt::format("{}", fmt::join(what, ", ")));
}

}  // namespace gloam::cli
