#include "cli/auto/shot.h"

#include <algorithm>
#include <map>
#include <memory>

#include "cli/auto/frame.h"
#include "cli/flags/memory.h"
#include "cli/shot/report.h"
#include "cli/shot/shot.h"
#include "gloam/error.h"
#include "sequence/chunks.h"
#include "shot/shot_run.h"

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

/// What all frames have in common.
struct AutoShotSettings {
  PlanRequest asked;
  AutoSettings computing;
  std::optional<double> radius;  ///< made from the first frame, for those effects that none is asked for
  RunOptions options;
  WriteOptions writing;
  std::optional<FramePattern> output;  ///< none: a composite alone
  AutoCompositeFlags composite;
  std::optional<FramePattern> composite_output = {};  ///< none: no composite
  bool keeps_depth = false;
  std::vector<Unfit> unfit;  ///< of the first frame, left out of all: nothing comes and goes by a share of pixels
  int decider = 0;           ///< number of that frame
  std::string contents;      ///< as FrameStep::settings_of
};

unsigned long long bytes_in_flight(const AutoFrame& planned, const std::optional<CompositeSource>& source) {
  const unsigned long long results = bytes_of_results(planned);
  return bytes_to_read(planned.files, planned.planes) + bytes_of(source) + results + results / 2;
}

/// The frames that called for an effect, by what was done there: a technique's name; "" where it was not wanted.
using FramesByTechnique = std::map<std::string, std::vector<int>>;

/// Of a shot's effects, by their names.
class Tally {
 public:
  void add(int frame, const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes) {
      const EffectChoice& effect = outcome.decision.effect;
      if (!outcome.plan) continue;
      const std::string runs = outcome.runs() ? outcome.decision.request.outputs.front() : "";
      effects_[effect.technique->effect.name][runs].push_back(frame);
      ++frames_[effect.technique->effect.name];
    }
  }
  /// "ambient occlusion: wanted in 3 of 5 frames: gtao in 1-3; not wanted in 4-5, and written as if computed there"
  std::vector<std::string> in_words() const {
    std::vector<std::string> lines;
    for (const auto& [effect, by_technique] : effects_) {
      const auto idle = by_technique.find("");
      const size_t not_wanted = idle == by_technique.end() ? 0 : idle->second.size();
      std::vector<std::string> parts;
      for (const auto& [technique, frames] : by_technique)
        if (!technique.empty()) parts.push_back(fmt::format("{} in {}", technique, frames_as_flag(frames)));
      if (not_wanted > 0) parts.push_back(fmt::format("not wanted in {}", frames_as_flag(idle->second)));
      const size_t all = frames_.at(effect);
      lines.push_back(fmt::format("{}: wanted in {} of {} frames computed: {}", effect, all - not_wanted, all,
                                  fmt::join(parts, ", ")));
    }
    return lines;
  }

 private:
  std::map<std::string, FramesByTechnique> effects_;
  std::map<std::string, size_t> frames_;
};

/// gloam auto on the frames of a shot.
class AutoStep : public FrameStep {
 public:
  AutoStep(const ShotFiles& files, const AutoShotSettings& settings, const DeviceFlags& device, ShotEvents& events)
      : files_(files),
        settings_(settings),
        computing_(settings.computing),
        contents_(settings.contents),
        device_(device.open()),
        notes_(files, events) {}

  /// Decides on the first frame what all frames take over: nothing comes and goes by what it changes, and a budget is spent once. What
  /// was decided tells results by other decisions apart.
  void decide_on(AutoFrame& first) {
    if (!computing_.goal && !looks_at_changes(first.candidates)) return;
    const Frame frame = first.files.read(first.planes);
    set_radius(first, settings_.radius);
    const AutoResult result = compute_effects(first, computing_, frame, device_, settings_.options);
    note(result.notes);
    computing_.fixed = fixed_by(result);
    std::vector<std::string> lines;
    for (const auto& [technique, fixed] : *computing_.fixed) {
      const std::string& effect = find_technique(technique).effect.name;
      lines.push_back(fixed.runs ? fmt::format("{}: {}, {} in all frames, as chosen on the first", effect,
                                               fmt::join(fixed.request.outputs, " + "), fixed.setting)
                                 : fmt::format("{}: in no frame; {}", effect, fixed.why));
    }
    if (result.spent)
      if (const std::string missed = note_on_goal(*result.spent, computing_.goal); !missed.empty())
        lines.push_back(missed);
    computing_.goal = {};
    note(lines);
    contents_ += fmt::format("{}", fmt::join(lines, "; "));
  }

  std::vector<ShotOutput> outputs() const override {
    std::vector<ShotOutput> outputs;
    if (settings_.output) outputs.push_back({*settings_.output, ""});
    if (settings_.composite_output) outputs.push_back({*settings_.composite_output, ""});
    return outputs;
  }
  std::string settings_of(const FrameFiles& /*files*/) override { return contents_; }
  std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) override;

  const Tally& tally() const { return tally_; }

 private:
  class Work;

  /// What a frame shows to be unfit is used all the same if it was sound in the first.
  void add_notes(const FrameTurn& turn, std::vector<std::string> notes) {
    for (std::string& text : notes) text = note_in_shot(text, settings_.unfit, settings_.decider);
    notes_.add(turn.frame, notes);
  }

  const ShotFiles& files_;
  const AutoShotSettings& settings_;
  AutoSettings computing_;
  std::string contents_;
  Device device_;
  ShotNotes notes_;
  Tally tally_;
  bool is_composition_told_ = false;
};

class AutoStep::Work : public FrameWork {
 public:
  Work(AutoStep& step, AutoFrame planned, std::optional<CompositeSource> source)
      : step_(step), planned_(std::move(planned)), source_(std::move(source)) {}

  unsigned long long bytes() const override { return bytes_in_flight(*planned_, source_); }

  void decode() override {
    frame_ = planned_->files.read(planned_->planes);
    if (source_) read_colour(*source_);
    step_.add_notes(turn, frame_.assumed);
  }

  void compute() override {
    const AutoShotSettings& settings = step_.settings_;
    AutoResult result = compute_effects(*planned_, step_.computing_, frame_, step_.device_, settings.options);
    note(result.notes);
    result_ = std::move(result.frame);
    compose();
    keep_first_outputs(result.outcomes);
    // Where nothing is called for, a frame with a plane is written all the same.
    const bool is_empty = result_.views.front().planes.empty();
    if (settings.keeps_depth || (settings.output && is_empty)) take_depth();
    result_.attributes.merge(attributes_of(making));
    if (result.used_radius && result.used_radius->from == RadiusSource::frame)
      note({fmt::format("radius: {:g} for all frames, made from the first; --radius gives another",
                        result.used_radius->value)});
    step_.tally_.add(turn.frame.number, result.outcomes);
    frame_ = {};
    planned_.reset();
  }

  void write() override {
    const AutoShotSettings& settings = step_.settings_;
    const int number = turn.frame.number;
    if (settings.output) write_frame(settings.output->path_of(number), result_, settings.writing);
    if (composite_)
      write_composite(settings.composite_output->path_of(number), *composite_, settings.writing.compression);
  }

 private:
  /// The picture, if one is asked for, while all planes of the effects are at hand.
  void compose() {
    if (!source_) return;
    composite_.emplace(make_composite(*source_, result_));
    composite_->picture.attributes.merge(attributes_of(making));
    step_.add_notes(turn, composite_->composition.notes);
    if (!step_.is_composition_told_) note({composition_in_words(composite_->composition)});
    step_.is_composition_told_ = true;
    source_.reset();
  }

  /// Of each effect, with the extras asked for.
  void keep_first_outputs(const std::vector<Outcome>& outcomes) {
    std::vector<std::string> kept = step_.settings_.asked.with;
    for (const Outcome& outcome : outcomes)
      if (!outcome.outputs.empty()) add_new(kept, outcome.outputs.front());
    keep_planes(result_, kept);
  }

  void take_depth() {
    for (View& view : result_.views) view.planes["depth"] = std::move(frame_.view(view.name).planes.at("depth"));
  }

  AutoStep& step_;
  std::optional<AutoFrame> planned_;
  std::optional<CompositeSource> source_;
  std::optional<Composite> composite_;
  Frame frame_, result_;
};

std::unique_ptr<FrameWork> AutoStep::begin(const FrameTurn& turn, FrameFiles files) {
  AutoFrame planned = planned_auto(std::move(files), settings_.asked, computing_.purpose, settings_.unfit);
  if (settings_.output) check_has_depth(planned, settings_.output->path_of(turn.frame.number).string());
  set_radius(planned, settings_.radius);
  auto source = open_composite(settings_.composite, files_.paths_of(turn.frame), files_.options_for(turn.frame));
  leave_out(source, settings_.unfit);
  return std::make_unique<Work>(*this, std::move(planned), std::move(source));
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

FirstFrame first_frame(const ShotFiles& shot, const PlanRequest& asked, const AutoCommand& flags) {
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
    auto source = open_composite(flags.composite, shot.paths_of(frame), shot.options_for(frame));
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
  const ShotFiles shot(flags.frame, flags.frame_flags, flags.shot.choice);
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
                            .writing = {!flags.shot.as_float, flags.compression},
                            .output = flags.out.empty() ? std::nullopt : std::optional(outputs.front().second),
                            .composite = flags.composite,
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
  AutoStep step(shot, settings, flags.run_flags, report);
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
