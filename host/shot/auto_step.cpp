#include "shot/auto_step.h"

#include <algorithm>
#include <limits>

#include "base/lists.h"
#include "gloam/frame_numbers.h"
#include "gloam/margin.h"
#include "gloam/option.h"
#include "sequence/chunks.h"
#include "shot/cuts.h"
#include "shot/memory.h"

namespace gloam {

unsigned long long bytes_of_auto(const AutoFrame& planned, bool shares_memory) {
  return process_bytes_with_device + bytes_to_read(planned.files, planned.planes) +
         bytes_beside_frame(planned, shares_memory);
}

unsigned long long bytes_in_flight(const AutoFrame& planned, const std::optional<CompositeSource>& source) {
  const unsigned long long results = bytes_of_results(planned);
  return bytes_to_read(planned.files, planned.planes) + bytes_of(source) + results + results / 2;
}

void EffectTally::add(int frame, const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    const EffectChoice& effect = outcome.decision.effect;
    if (!outcome.plan) continue;
    const std::string runs = outcome.runs() ? outcome.decision.request.outputs.front() : "";
    effects_[effect.technique->effect.name][runs].push_back(frame);
    ++frames_[effect.technique->effect.name];
  }
}

std::vector<std::string> EffectTally::in_words() const {
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

namespace {

/// The radius that was asked for; none: that of the shot is used.
std::optional<double> radius_asked_for(const AutoFrame& frame) {
  for (size_t i = 0; i < frame.plans.size(); ++i) {
    const auto radius = radius_of(frame.plans[i].front(), frame.candidates.possible[i].asked, RadiusSource::frame);
    if (radius && radius->from == RadiusSource::flag) return radius->value;
  }
  return {};
}

}  // namespace

AutoFrame AutoStep::planned(FrameFiles files) const {
  AutoFrame planned = planned_auto(std::move(files), settings_.asked, settings_.computing.purpose, settings_.unfit);
  set_radius(planned, settings_.radius);
  return planned;
}

AutoStep::Decided AutoStep::decided_on(AutoFrame& first, const std::string& what) {
  Decided decided{settings_.computing, settings_.contents};
  const Frame frame = first.files.read(first.planes);
  decided.computing.for_other_frames = true;
  const AutoResult result = compute_effects(first, decided.computing, frame, device_, settings_.options);
  for (const std::string& sentence : result.notes) events_.note(sentence);
  decided.computing.fixed = fixed_by(result);
  for (const auto& [technique, fixed] : *decided.computing.fixed) {
    const std::string& effect = find_technique(technique).effect.name;
    const std::string runs = fmt::format("{}, {}", fmt::join(fixed.request.outputs, " + "), fixed.setting);
    events_.note(fixed.runs ? fmt::format("{}: {} in {}, as chosen on the first of them", effect, runs, what)
                            : fmt::format("{}: not in {}; {}", effect, what, fixed.why));
    // Neither the times nor the frames, which differ from run to run.
    decided.contents += fmt::format("; {}: {}", effect, fixed.runs ? runs : "none");
  }
  if (const std::string missed = note_on_goal(result, settings_.computing.goal); !missed.empty()) events_.note(missed);
  if (result.spent && !result.spent->why.empty()) events_.note(result.spent->why);
  decided.computing.goal = {};
  return decided;
}

void AutoStep::decide_on(AutoFrame& first) {
  if (!settings_.computing.goal && !looks_at_changes(first.candidates)) return;
  set_radius(first, settings_.radius);
  const double radius = radius_asked_for(first).value_or(settings_.radius.value_or(0));
  const std::vector<int> cuts = cuts_in(poses_of(files_), radius);
  std::vector<int> starts = {std::numeric_limits<int>::min()};
  starts.insert(starts.end(), cuts.begin(), cuts.end());
  for (size_t i = 0; i < starts.size(); ++i) {
    std::vector<int> numbers;
    for (const SequenceFrame& frame : files_.frames())
      if (frame.number >= starts[i] && (i + 1 == starts.size() || frame.number < starts[i + 1]))
        numbers.push_back(frame.number);
    const std::string what = cuts.empty() ? "all frames" : fmt::format("frames {}", frames_as_flag(numbers));
    if (i == 0) {
      decided_[starts[i]] = decided_on(first, what);
      continue;
    }
    events_.note(fmt::format("frame {}: the camera jumps, so that what is computed is chosen anew", starts[i]));
    try {
      const auto at = [&](const SequenceFrame& frame) { return frame.number == starts[i]; };
      AutoFrame next = planned(files_.open(*std::find_if(files_.frames().begin(), files_.frames().end(), at)));
      check_goal(settings_.computing.goal, next);
      decided_[starts[i]] = decided_on(next, what);
    } catch (const Error& error) {
      events_.note(fmt::format("frame {}: cannot be chosen for, so that what was chosen before it stays: {}", starts[i],
                               error.what()));
    }
  }
}

std::vector<ShotOutput> AutoStep::outputs() const {
  std::vector<ShotOutput> outputs;
  if (settings_.output) outputs.push_back({*settings_.output, ""});
  if (settings_.composite_output) outputs.push_back({*settings_.composite_output, ""});
  return outputs;
}

void AutoStep::add_notes(const FrameTurn& turn, std::vector<std::string> notes) {
  for (std::string& text : notes) text = note_in_shot(text, settings_.unfit, settings_.decider);
  notes_.add(turn.frame, notes);
}

class AutoStep::Work : public FrameWork {
 public:
  Work(AutoStep& step, AutoFrame planned, std::optional<CompositeSource> source)
      : step_(step), planned_(std::move(planned)), source_(std::move(source)) {}

  unsigned long long bytes() const override { return bytes_in_flight(*planned_, source_); }

  void decode() override {
    frame_ = planned_->files.read(planned_->planes);
    if (source_) read_colour(*source_);
    const bool keeps_margin = step_.settings_.writing.keeps_margin;
    step_.add_notes(turn, frame_.assumed);
    step_.add_notes(turn, notes_on_margin(frame_, keeps_margin, keeps_margin));
  }

  void compute() override {
    const AutoShotSettings& settings = step_.settings_;
    AutoResult result = compute_effects(*planned_, step_.decided_for(turn.frame.number).computing, frame_,
                                        step_.device_, settings.options);
    for (const std::string& sentence : result.notes) step_.events_.note(sentence);
    result_ = std::move(result.frame);
    compose();
    keep_first_outputs(result.outcomes);
    // Where nothing is called for, a frame with a plane is written all the same.
    const bool is_empty = result_.views.front().planes.empty();
    if (settings.keeps_depth || (settings.output && is_empty)) take_depth();
    result_.attributes.merge(attributes_of(making));
    if (result.used_radius && result.used_radius->from == RadiusSource::frame)
      step_.events_.note(fmt::format("radius: {:g} for all frames, made from the first; {} gives another",
                                     result.used_radius->value, option("radius")));
    step_.tally_.add(turn.frame.number, result.outcomes);
    frame_ = {};
    planned_.reset();
  }

  void write() override {
    const AutoShotSettings& settings = step_.settings_;
    const int number = turn.frame.number;
    if (settings.output) write_frame(settings.output->path_of(number), result_, settings.writing);
    if (composite_) write_composite(settings.composite_output->path_of(number), *composite_, settings.writing);
  }

 private:
  /// The picture, if one is asked for, while all planes of the effects are at hand.
  void compose() {
    if (!source_) return;
    composite_.emplace(make_composite(*source_, result_));
    composite_->picture.attributes.merge(attributes_of(making));
    step_.add_notes(turn, composite_->composition.notes);
    if (!step_.is_composition_told_) step_.events_.note(composition_in_words(composite_->composition));
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
  AutoFrame planned = this->planned(std::move(files));
  if (settings_.output) check_has_depth(planned, settings_.output->path_of(turn.frame.number).string());
  auto source = open_composite(settings_.composite, files_.paths_of(turn.frame), files_.options_for(turn.frame));
  leave_out(source, settings_.unfit);
  return std::make_unique<Work>(*this, std::move(planned), std::move(source));
}

}  // namespace gloam
