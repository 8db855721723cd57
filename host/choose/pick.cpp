#include "choose/pick.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "base/elapsed.h"
#include "base/lists.h"
#include "base/memory.h"
#include "base/temporary_folder.h"
#include "choose/document.h"
#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/option.h"
#include "gloam/pick.h"
#include "measure/effects.h"
#include "measure/schedule.h"
#include "measure/similarity.h"
#include "planner/goal.h"
#include "planner/reason.h"

namespace gloam::bench {
namespace {

/// The technique of ambient occlusion that is nearest to ray-traced truth on the built-in scenes, with a single layer
/// (kernels/evidence/README.md).
const std::string stand_in = "evidence";

class Search {
 public:
  Search(const Subject& subject, const PickOptions& options, Device& device)
      : subject_(subject),
        options_(options),
        device_(device),
        available_(planes_of(subject.frame)),
        first_view_only_(any_makes_first_view_only(options.techniques)),
        foreground_(foreground(subject.frame, first_view_only_)) {}

  Picked run() {
    find_truth();
    const std::vector<Variation> all = candidates();
    ContestResult outcome = hold_contest(all, options_,
                                         {.attempt = [&](size_t i) { return attempt(i, all[i]); },
                                          .time = [&](size_t i) { return time_of(*timed_.at(i), *all[i].technique); }});
    picked_.tried = outcome.tried;
    picked_.left_out = std::move(outcome.left_out);
    check(outcome);
    measure_likeness(outcome.finalists, *outcome.best);
    for (const Contestant& entry : outcome.finalists) picked_.finalists.push_back(entry.choice);
    picked_.best = *outcome.best;
    picked_.why = why_best(outcome);
    return std::move(picked_);
  }

 private:
  void tell(const std::string& what, size_t done, size_t of) const {
    if (options_.progress) options_.progress(what, double(done) / double(std::max<size_t>(of, 1)));
  }

  Image image_of(const Plan& plan, const RunOptions& run_options) const {
    return bench::image_of(gloam::run(plan, subject_.frame, device_, run_options).frame, subject_.effect);
  }

  void find_truth() {
    if (subject_.truth) {
      for (const auto& [view, plane] : subject_.truth->image) truth_.emplace(view, plane.clone());
      picked_.truth = "the truth";
      return;
    }
    if (subject_.effect != "ao") return stand_in_for_truth();
    const Technique* technique = &find_technique(stand_in);
    if (const Technique* layers = over_all_layers(*technique); layers && has_layers()) technique = layers;
    converge(*technique);
  }

  void converge(const Technique& technique) {
    tell("converged " + technique.name, 0, 1);
    Variation converged{.technique = &technique, .radius = subject_.radius.value};
    converged.settings = converged_settings(technique);
    truth_ = image_of(whole_plan(converged, available_, subject_.holds), {});
    picked_.truth = "converged " + technique.name + ", as no truth is at hand";
    picked_.has_truth = false;
  }

  /// Of an effect other than ambient occlusion: the first technique over layers that the frame has, else the first.
  void stand_in_for_truth() {
    for (const bool over_layers : {true, false}) {
      for (const Technique* technique : options_.techniques) {
        if (reads_layers(*technique) != over_layers || converged_settings(*technique).empty()) continue;
        try {
          return converge(*technique);
        } catch (const MissingPlanes&) {
          continue;
        }
      }
    }
    throw Error("{}: has no truth of {}, and no technique tells one; {} gives it", subject_.name, subject_.effect,
                option("truth"));
  }

  bool has_layers() const {
    return std::any_of(available_.begin(), available_.end(),
                       [](const std::string& plane) { return plane.rfind("peel.", 0) == 0; });
  }

  std::vector<Variation> candidates() {
    std::vector<Variation> all;
    for (const Technique* technique : options_.techniques) {
      std::vector<std::string> presets;
      for (const Preset& preset : source_of(*technique).presets) presets.push_back(preset.name);
      if (presets.empty()) presets.push_back("");
      for (const std::string& preset : presets) {
        const Variation v{.technique = technique, .preset = preset, .radius = subject_.radius.value};
        for (const Variation& each : {v, with_variant(v, "half")})
          if (is_possible(each)) all.push_back(each);
      }
    }
    return all;
  }

  /// Without a run: whether the frame has what the setting reads.
  bool is_possible(const Variation& v) try {
    whole_plan(v, available_, subject_.holds);
    return true;
  } catch (const MissingPlanes& error) {
    picked_.skipped.push_back({v.technique->name, v.name(), "", error.what()});
    return false;
  }

  std::optional<Choice> attempt(size_t i, const Variation& variation) try {
    const Plan plan = whole_plan(variation, available_, subject_.holds);
    auto timed = std::make_unique<TimedPlan>(plan, subject_.frame, device_, variation.run_options());
    Choice choice{.variation = variation};
    choice.ms = time_of(*timed, *variation.technique);
    measure(choice, image_of(plan, variation.run_options()), options_.by != PickBy::rmse);
    timed_[i] = std::move(timed);
    return choice;
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {  // a device without the memory
    picked_.skipped.push_back({variation.technique->name, variation.name(), "", error.what()});
    return {};
  }

  void measure(Choice& choice, const Image& image, bool with_likeness) const {
    choice.rmse = rmse(image, truth_, foreground_);
    if (!with_likeness) return;
    int views = 0;
    double ssim = 0, flip = 0;
    for (const auto& [view, mask] : foreground_) {
      const auto test = image.find(view), truth = truth_.find(view);
      if (test == image.end() || truth == truth_.end()) continue;
      if (std::all_of(mask.begin(), mask.end(), [](unsigned char m) { return m == 0; })) continue;
      const Metrics figures = metrics_of(test->second, truth->second, mask);
      ssim += figures.ssim;
      flip += figures.flip.value_or(0);
      ++views;
    }
    if (views == 0) return;
    choice.ssim = ssim / views;
    if (options_.by == PickBy::flip) choice.flip = flip / views;
  }

  /// Milliseconds of one run, over the views that all techniques make.
  double time_of(TimedPlan& timed, const Technique& technique) const {
    const double ms = timed.run();
    const bool counts_in_full = !first_view_only_ || makes_first_view_only(technique);
    return counts_in_full ? ms : timed.first_view_ms();
  }

  /// SSIM of the finalists where it does not decide: of the best first, then as far as the time allows.
  void measure_likeness(std::vector<Contestant>& finalists, size_t best) {
    if (options_.by != PickBy::rmse) return;
    std::vector<Contestant*> order = {&finalists[best]};
    for (size_t i = 0; i < finalists.size(); ++i)
      if (i != best) order.push_back(&finalists[i]);
    Expected likeness(2e-6 * subject_.frame.width() * subject_.frame.height() * double(subject_.frame.views.size()));
    for (size_t i = 0; i < order.size(); ++i) {
      tell("SSIM", i, order.size());
      likeness.done_within(options_.limit, [&] {
        const TimedPlan& timed = *timed_.at(order[i]->index);
        measure(order[i]->choice, image_of(timed.plan(), order[i]->choice.variation.run_options()), true);
      });
    }
  }

  /// Throws Error that names the nearest miss if nothing is within the bound.
  void check(const ContestResult& outcome) const {
    if (outcome.tried == 0 && picked_.skipped.empty())
      throw Error("{}: no setting could be tried in time; {} gives more, {} all that it takes", subject_.name,
                  option("time"), option("all"));
    if (outcome.tried == 0) throw Error("{}: nothing can be measured: {}", subject_.name, picked_.skipped.back().why);
    if (outcome.best) return;
    throw Error("{}", why_none(figures_of_all(outcome.finalists), options_.goal, words_for(outcome.finalists)));
  }

  /// Among all that were tried; the finalists come first.
  std::string why_best(const ContestResult& outcome) const {
    std::vector<Contestant> all = outcome.finalists;
    all.insert(all.end(), outcome.others.begin(), outcome.others.end());
    return why_chosen(figures_of_all(all), *outcome.best, options_.goal, words_for(all));
  }

  std::vector<Figures> figures_of_all(const std::vector<Contestant>& all) const {
    std::vector<Figures> figures;
    for (const Contestant& entry : all) figures.push_back(figures_of(entry.choice, options_.by));
    return figures;
  }

  OptionWords words_for(const std::vector<Contestant>& all) const {
    return {.label = [&all](size_t i) { return option_of(all[i].choice.variation).label(); },
            .error = name_of_error(options_.by),
            .truth = picked_.truth};
  }

  const Subject& subject_;
  const PickOptions& options_;
  Device& device_;
  const std::vector<std::string> available_;
  const bool first_view_only_;
  const Foreground foreground_;
  Image truth_;
  std::map<size_t, std::unique_ptr<TimedPlan>> timed_;  ///< by the index of the setting
  Picked picked_;
};

}  // namespace

Picked pick(const Subject& subject, const PickOptions& options, Device& device) {
  return Search(subject, options, device).run();
}

std::string effect_to_pick(const std::vector<std::string>& truths, const std::vector<std::string>& techniques) {
  std::vector<std::string> effects;
  if (techniques.empty()) effects = effects_in(truths);
  for (const std::string& name : techniques) add_new(effects, measured_plane(find_technique(name)));
  if (effects.size() > 1)
    throw UsageError("pick: {} are several effects; give the truth, or the techniques, of one", enumerate(effects));
  return effects.empty() || effects.front().empty() ? "ao" : effects.front();
}

std::vector<const Technique*> techniques_to_pick(const std::vector<std::string>& names, const std::string& effect,
                                                 std::vector<Skipped>& left_out, const VariantChoice& variant) {
  std::vector<const Technique*> techniques;
  const bool all = names.empty();
  for (const std::string& name : all ? techniques_making({effect}) : names) {
    const Technique& technique = find_technique(name);
    if (all && !fits(technique, variant)) continue;
    if (const std::string why = why_not_measured(technique, {effect}); !why.empty())
      throw UsageError("{}: {}; there are {}", option("techniques", name), why, enumerate(techniques_making({effect})));
    if (const std::string why = needs_naming(technique, variant); all && !why.empty())
      left_out.push_back({name, "", "", why});
    else if (std::find(techniques.begin(), techniques.end(), &technique) == techniques.end())
      techniques.push_back(&technique);
  }
  check_any_fits(techniques, variant, {effect});
  return techniques;
}

PickedOnFrame pick_on_frame(const OwnFrame& own, const std::string& effect, PickOptions options,
                            const SceneOptions& scene, const std::vector<Skipped>& left_out, Device& device,
                            const TellNotes& tell) {
  const auto start = std::chrono::steady_clock::now();
  PickedOnFrame made{own_subject(own, effect, options.techniques, scene, tell), {}};
  if (own.truths.empty() && made.subject.truth) options.limit.extend(seconds_since(start));
  made.picked = pick(made.subject, options, device);
  made.picked.skipped.insert(made.picked.skipped.end(), left_out.begin(), left_out.end());
  return made;
}

}  // namespace gloam::bench

namespace gloam {
namespace {

unsigned long long affordable(const std::string& name, unsigned long long bytes) {
  if (bytes <= available_memory()) return bytes;
  throw Error(
      "{}: would take about {} of memory, and {} are available; name fewer techniques, or crop or shrink the frame",
      name, memory_in_words(bytes), memory_in_words(available_memory()));
}

}  // namespace

PickResult pick_setting(const std::string& frame, const PickRequest& request, Device& device) {
  using namespace bench;
  check_has_goal(request.goal, "pick");
  const PickBy by = value_of(request.by, "by", pick_figures);
  if (by == PickBy::flicker) throw UsageError("by flicker: is of a shot, and {} is one frame", frame);
  std::vector<Skipped> left_out;
  const std::string effect = effect_to_pick(request.truths, request.techniques);
  PickOptions options{.techniques = techniques_to_pick(request.techniques, effect, left_out),
                      .goal = request.goal,
                      .by = by,
                      .rounds = request.rounds,
                      .progress = request.progress};
  if (request.seconds) options.limit = TimeLimit(*request.seconds);
  const TemporaryFolder scratch("pick");
  const SceneOptions scene{
      .folder = scratch.path(), .rays = request.rays, .radius = request.radius, .progress = request.progress};
  PickResult result;
  const auto tell = [&](const std::vector<std::string>& notes) { add_new(result.notes, notes); };
  const OwnFrame own{frame, request.reading, request.truths, &affordable};
  const PickedOnFrame made = pick_on_frame(own, effect, options, scene, left_out, device, tell);
  const Picked& picked = made.picked;
  for (const bench::Choice& choice : picked.finalists) {
    const Variation& v = choice.variation;
    result.finalists.push_back(
        {v.technique->name, v.name(), resolution_of(v), choice.ms, choice.rmse, choice.ssim, choice.flip});
  }
  result.best = picked.best;
  result.why = picked.why;
  result.not_tried = not_tried_in_words(picked.left_out, picked.skipped);
  result.error_to = picked.truth;
  result.has_truth = picked.has_truth;
  result.radius = made.subject.radius;
  if (!picked.has_truth) tell({stand_in_warning(picked)});
  result.json = document_of(picked, by, device.info()).dump();
  return result;
}

}  // namespace gloam
