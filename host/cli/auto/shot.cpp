#include "cli/auto/shot.h"

#include <algorithm>
#include <map>
#include <memory>

#include "base/page_pool.h"
#include "cli/auto/frame.h"
#include "cli/shot/memory.h"
#include "cli/shot/start.h"
#include "cli/shot/steps.h"
#include "gloam/error.h"
#include "sequence/chunks.h"
#include "sequence/frame_making.h"

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
  bool keeps_depth = false, resumes = false;
  std::vector<Unfit> unfit;       ///< of the first frame, left out of all: nothing comes and goes by a share of pixels
  int decider = 0;                ///< number of that frame
  std::string version, contents;  ///< as in FrameMaking
  Window display;
  unsigned long long frame_bytes = 0;
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

/// The steps of a frame, for a `Pipeline`.
class AutoShotWork {
 public:
  AutoShotWork(const ShotFiles& files, const AutoShotSettings& settings, const DeviceFlags& device, ShotReport& report,
               std::function<void()> stop)
      : files_(files),
        settings_(settings),
        computing_(settings.computing),
        device_(device.open()),
        report_(report),
        steps_(files, report, std::move(stop)),
        flights_(files.frames().size()) {}

  /// Decides on the first frame what all frames take over: nothing comes and goes by what it changes, and a budget is spent once. Says
  /// what was decided, as text that tells results by other decisions apart.
  std::string decide_on(AutoFrame& first) {
    if (!computing_.goal && !looks_at_changes(first.candidates)) return "";
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
    return fmt::format("{}", fmt::join(lines, "; "));
  }

  bool decode(size_t i) {
    flights_[i] = std::make_unique<InFlight>();
    return step(i, &StepTimes::decode, [&](InFlight& flight) {
      if (!open(i, flight)) return false;
      flight.frame = flight.planned->files.read(flight.planned->planes);
      if (flight.source) read_colour(*flight.source);
      add_notes(i, flight.frame.assumed);
      return true;
    });
  }

  /// On one thread.
  bool compute(size_t i) {
    return step(i, &StepTimes::compute, [&](InFlight& flight) {
      AutoResult result = compute_effects(*flight.planned, computing_, flight.frame, device_, settings_.options);
      note(result.notes);
      flight.result = std::move(result.frame);
      compose(i, flight);
      keep_first_outputs(flight.result, result.outcomes);
      // Where nothing is called for, a frame with a plane is written all the same.
      const bool is_empty = flight.result.views.front().planes.empty();
      if (settings_.keeps_depth || (settings_.output && is_empty)) take_depth(flight.frame, flight.result);
      flight.result.attributes.merge(attributes_of(flight.making));
      if (result.used_radius && result.used_radius->from == RadiusSource::frame)
        note({fmt::format("radius: {:g} for all frames, made from the first; --radius gives another",
                          result.used_radius->value)});
      tally_.add(files_.frames()[i].number, result.outcomes);
      flight.frame = {};
      flight.planned.reset();
      return true;
    });
  }

  bool write(size_t i) {
    const bool is_written = step(i, &StepTimes::write, [&](InFlight& flight) {
      if (settings_.output) write_frame(output_of(i), flight.result, settings_.writing);
      if (flight.composite) write_composite(composite_of(i), *flight.composite, settings_.writing.compression);
      return true;
    });
    if (!is_written) return false;
    report_.done(files_.frames()[i].number, flights_[i]->times);
    flights_[i].reset();
    return true;
  }

  const Tally& tally() const { return tally_; }

 private:
  struct InFlight {
    std::optional<AutoFrame> planned;
    std::optional<CompositeSource> source;
    std::optional<Composite> composite;
    Frame frame, result;
    FrameMaking making;
    StepTimes times;
  };

  std::filesystem::path output_of(size_t i) const { return settings_.output->path_of(files_.frames()[i].number); }

  std::filesystem::path composite_of(size_t i) const {
    return settings_.composite_output->path_of(files_.frames()[i].number);
  }

  /// What a frame shows to be unfit is used all the same if it was sound in the first.
  void add_notes(size_t i, std::vector<std::string> notes) {
    for (std::string& text : notes) text = note_in_shot(text, settings_.unfit, settings_.decider);
    steps_.add_notes(i, notes);
  }

  /// The first of a frame's files that --resume makes again, and why; empty if none is.
  std::pair<std::filesystem::path, std::string> first_to_write_again(size_t i, const FrameMaking& making) const {
    std::vector<std::filesystem::path> paths;
    if (settings_.output) paths.push_back(output_of(i));
    if (settings_.composite_output) paths.push_back(composite_of(i));
    for (const std::filesystem::path& path : paths) {
      if (std::string why = why_again(path, making); !why.empty()) return {path, why};
    }
    return {paths.front(), ""};
  }

  /// The picture, if one is asked for, while all planes of the effects are at hand.
  void compose(size_t i, InFlight& flight) {
    if (!flight.source) return;
    flight.composite.emplace(make_composite(*flight.source, flight.result));
    flight.composite->picture.attributes.merge(attributes_of(flight.making));
    add_notes(i, flight.composite->composition.notes);
    if (!is_composition_told_) note({composition_in_words(flight.composite->composition)});
    is_composition_told_ = true;
    flight.source.reset();
  }

  bool open(size_t i, InFlight& flight) {
    const SequenceFrame& frame = files_.frames()[i];
    FrameFiles files = files_.open(frame);
    flight.making = {settings_.version, settings_.contents, identity_of(files)};
    if (settings_.resumes) {
      const auto [path, why] = first_to_write_again(i, flight.making);
      if (report_.leaves_alone(frame.number, path, why)) return false;
    }
    check_size_in_shot(files, settings_.display);
    flight.planned.emplace(planned_auto(std::move(files), settings_.asked, computing_.purpose, settings_.unfit));
    if (settings_.output) check_has_depth(*flight.planned, output_of(i).string());
    set_radius(*flight.planned, settings_.radius);
    if (auto source = open_composite(settings_.composite, files_.paths_of(frame), files_.options_for(frame))) {
      leave_out(source, settings_.unfit);
      flight.source.emplace(std::move(*source));
    }
    check_bytes_in_shot(flight.planned->files, bytes_in_flight(*flight.planned, flight.source), settings_.frame_bytes);
    return true;
  }

  /// Of each effect, with the extras asked for.
  void keep_first_outputs(Frame& frame, const std::vector<Outcome>& outcomes) const {
    std::vector<std::string> kept = settings_.asked.with;
    for (const Outcome& outcome : outcomes)
      if (!outcome.outputs.empty()) add_new(kept, outcome.outputs.front());
    keep_planes(frame, kept);
  }

  static void take_depth(Frame& from, Frame& to) {
    for (View& view : to.views) view.planes["depth"] = std::move(from.view(view.name).planes.at("depth"));
  }

  bool step(size_t i, double StepTimes::*time, const std::function<bool(InFlight&)>& work) {
    const bool goes_on = steps_.run(i, flights_[i]->times.*time, [&] { return work(*flights_[i]); });
    if (!goes_on) flights_[i].reset();
    return goes_on;
  }

  const ShotFiles& files_;
  const AutoShotSettings& settings_;
  AutoSettings computing_;
  Device device_;
  ShotReport& report_;
  ShotSteps steps_;
  Tally tally_;
  bool is_composition_told_ = false;
  std::vector<std::unique_ptr<InFlight>> flights_;
};

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
                            .resumes = flags.shot.resume,
                            .unfit = first.planned.unfit,
                            .decider = first.number,
                            .version = version_with_kernels(GLOAM_VERSION),
                            .contents = fmt::format("auto{} radius {}{}", flags.given, first.radius.value,
                                                    left_out_in_words(first.planned.unfit)),
                            .display = first.planned.files.files().front().display()};
  if (!flags.composite.path.empty()) settings.composite_output = outputs.back().second;
  const ShotMemory memory =
      shot_memory(first.planned.files.name(), bytes_in_flight(first.planned, first.source),
                  bytes_of_auto(first.planned, true), limit_of(flags.frame_flags, flags.shot.memory),
                  "ask for --resolution half, for one view (--view), or allow more");
  settings.frame_bytes = memory.frame;
  const PageReuse reuse(memory.all - process_bytes_with_device);
  const ShotStart start(outputs, shot.numbers());
  ShotReport report(shot.frames().size(), flags.json);
  Pipeline* running = nullptr;
  AutoShotWork work(shot, settings, flags.run_flags, report, [&] { running->stop(); });
  Pipeline pipeline(shot.frames().size(), memory.size,
                    {[&](size_t i) { return work.decode(i); }, [&](size_t i) { return work.compute(i); },
                     [&](size_t i) { return work.write(i); }});
  settings.contents += work.decide_on(first.planned);
  running = &pipeline;
  pipeline.run();
  note(work.tally().in_words());
  std::vector<std::string> files, what;
  if (settings.output) files.push_back(flags.out), what.emplace_back("effects");
  if (settings.composite_output) files.push_back(flags.composite.path), what.emplace_back("composite");
  report.finish(fmt::format("{}", fmt::join(files, ", ")), fmt::format("{}", fmt::join(what, ", ")));
}

}  // namespace gloam::cli
