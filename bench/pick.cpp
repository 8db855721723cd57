#include "bench/pick.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "base/elapsed.h"
#include "bench/effects.h"
#include "bench/schedule.h"
#include "compare/flip.h"
#include "gloam/error.h"
#include "gloam/metrics.h"

namespace gloam::bench {
namespace {

/// The technique of ambient occlusion that is nearest to ray-traced truth on the built-in scenes, with a single layer
/// (kernels/evidence/README.md).
const std::string stand_in = "evidence";
/// Number of settings timed in turn at the end.
constexpr size_t most_finalists = 12;
/// A setting is dropped only if its first time is over the bound by more than this factor.
constexpr double doubt = 1.5;

/// "medium", "medium, half": what is left out of a technique.
std::string name_and_resolution(const Variation& v) { return v.name() + (v.variant.empty() ? "" : ", " + v.variant); }

std::string name_of(const Variation& v) { return v.technique->name + " " + name_and_resolution(v); }

/// A plane of one or three components as displayed within the mask; black in both images elsewhere.
cv::Mat picture_of(const Plane& plane, const Mask& mask) {
  const Layout& layout = plane.channels[0].layout();
  const auto component = [&](size_t i) -> const Channel& {
    return plane.channels[std::min(i, plane.channels.size() - 1)];
  };
  cv::Mat picture(layout.height, layout.width, CV_64FC3, cv::Scalar(0, 0, 0));
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (mask[size_t(y) * size_t(layout.width) + size_t(x)]) {
        for (int i = 0; i < 3; ++i) picture.at<cv::Vec3d>(y, x)[i] = component(size_t(i)).at(x, y);
      }
    }
  }
  return picture;
}

double mean_flip(const Plane& test, const Plane& truth, const Mask& mask) {
  const cv::Mat map = flip_map(picture_of(test, mask), picture_of(truth, mask));
  const cv::Mat counted(map.rows, map.cols, CV_8U, const_cast<unsigned char*>(mask.data()));
  return cv::mean(map, counted)[0];
}

/// A tried setting: its plan, and the figures of one run.
struct Try : Choice {
  std::unique_ptr<TimedPlan> timed;
};

bool is_within(const Choice& tried, const PickOptions& options) {
  return options.budget ? tried.ms <= *options.budget : error_of(tried, options.by) <= *options.error;
}

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
    try_all();
    picked_.tried = tries_.size();
    keep_finalists();
    time_finalists();
    choose();
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
    throw Error("{}: has no truth of {}, and no technique tells one; --truth gives it", subject_.name, subject_.effect);
  }

  bool has_layers() const {
    return std::any_of(available_.begin(), available_.end(),
                       [](const std::string& plane) { return plane.rfind("peel.", 0) == 0; });
  }

  std::vector<Variation> candidates() const {
    std::vector<Variation> all;
    for (const Technique* technique : options_.techniques) {
      std::vector<std::string> presets;
      for (const Preset& preset : source_of(*technique).presets) presets.push_back(preset.name);
      if (presets.empty()) presets.push_back("");
      for (const std::string& preset : presets) {
        Variation v{.technique = technique, .preset = preset, .radius = subject_.radius.value};
        all.push_back(v);
        all.push_back(with_variant(v, "half"));
      }
    }
    return all;
  }

  void try_all() {
    const std::vector<Variation> all = candidates();
    const std::vector<size_t> first = first_looks(all, "low");
    try_these(all, first);
    const std::vector<double> distances = distances_of_tries();
    try_these(all, later_looks(all, first, [&](const Variation& v) {
                for (size_t i = 0; i < distances.size(); ++i) {
                  if (tries_[i]->variation.technique == v.technique) return distances[i];
                }
                return 1e3;
              }));
    if (tries_.empty() && picked_.skipped.empty())
      throw Error("{}: no setting could be tried in time; --time gives more, --all all that it takes", subject_.name);
    if (tries_.empty()) throw Error("{}: nothing can be measured: {}", subject_.name, picked_.skipped.back().why);
  }

  void try_these(const std::vector<Variation>& all, const std::vector<size_t>& order) {
    for (const size_t i : order) {
      const Variation& v = all[i];
      tell("trying " + name_of(v), tries_.size() + picked_.left_out.size(), all.size());
      if (!is_possible(v)) continue;
      std::string why = why_hopeless(v);
      // One is tried whatever the time, so that there is something to say.
      if (why.empty() && !tries_.empty() && !options_.limit.allows(longest_try_)) why = "the time was over";
      if (!why.empty()) {
        picked_.left_out.push_back({v.technique->name, name_and_resolution(v), "", why});
        continue;
      }
      const auto start = std::chrono::steady_clock::now();
      try {
        add(v);
      } catch (const UsageError&) {
        throw;
      } catch (const Error& error) {  // planes that the frame lacks, a device without the memory
        picked_.skipped.push_back({v.technique->name, v.name(), "", error.what()});
      }
      longest_try_ = std::max(longest_try_, seconds_since(start));
    }
  }

  /// Without a run: whether the frame has what the setting reads.
  bool is_possible(const Variation& v) try {
    whole_plan(v, available_, subject_.holds);
    return true;
  } catch (const MissingPlanes& error) {
    picked_.skipped.push_back({v.technique->name, v.name(), "", error.what()});
    return false;
  }

  std::vector<double> distances_of_tries() const {
    std::vector<FirstLook> looks;
    for (const auto& t : tries_) looks.push_back({t->ms, off(*t)});
    return distances_to_front(looks);
  }

  /// Empty, or why a setting cannot win: a lower preset of the technique, at the same resolution, is too slow already.
  std::string why_hopeless(const Variation& v) const {
    if (!options_.limit.is_set()) return "";
    double most = 0;
    if (options_.budget) {
      most = *options_.budget * doubt;
    } else {
      for (const auto& t : tries_) {
        if (is_within(*t, options_) && (most == 0 || t->ms * doubt < most)) most = t->ms * doubt;
      }
    }
    if (most == 0) return "";
    for (const auto& t : tries_) {
      const bool is_lower = t->variation.technique == v.technique && t->variation.resolution == v.resolution &&
                            rank(t->variation) < rank(v);
      if (is_lower && t->ms > most) return fmt::format("{} takes {:.2g} ms already", name_of(t->variation), t->ms);
    }
    return "";
  }

  /// Place of the preset among those of the technique, which are sorted by their time.
  static size_t rank(const Variation& v) {
    const std::vector<Preset>& presets = source_of(*v.technique).presets;
    for (size_t i = 0; i < presets.size(); ++i) {
      if (presets[i].name == v.preset) return i;
    }
    return 0;
  }

  void add(const Variation& variation) {
    const Plan plan = whole_plan(variation, available_, subject_.holds);
    auto tried = std::make_unique<Try>();
    tried->variation = variation;
    tried->timed = std::make_unique<TimedPlan>(plan, subject_.frame, device_, variation.run_options());
    tried->ms = time_of(*tried);
    measure(*tried, image_of(plan, variation.run_options()), options_.by != PickBy::rmse);
    tries_.push_back(std::move(tried));
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
      ssim += compare(test->second, truth->second, mask).ssim;
      if (options_.by == PickBy::flip) flip += mean_flip(test->second, truth->second, mask);
      ++views;
    }
    if (views == 0) return;
    choice.ssim = ssim / views;
    if (options_.by == PickBy::flip) choice.flip = flip / views;
  }

  /// Milliseconds of one run, over the views that all techniques make.
  double time_of(Try& tried) const {
    const double ms = tried.timed->run();
    const bool counts_in_full = !first_view_only_ || makes_first_view_only(*tried.variation.technique);
    return counts_in_full ? ms : tried.timed->first_view_ms();
  }

  void keep_finalists() {
    std::vector<Choice> choices;
    for (const auto& t : tries_) choices.push_back(*t);
    std::vector<std::unique_ptr<Try>> kept;
    for (const size_t i : finalists_of(choices, options_)) kept.push_back(std::move(tries_[i]));
    tries_ = std::move(kept);
  }

  void time_finalists() {
    std::vector<Contender> contenders;
    for (const auto& t : tries_)
      contenders.push_back({name_of(t->variation), [this, &tried = *t] { return time_of(tried); }});
    const std::vector<Series> times =
        interleaved(contenders, options_.rounds, [&](int done, int of) { tell("timing", size_t(done), size_t(of)); });
    for (size_t i = 0; i < tries_.size(); ++i) tries_[i]->ms = median(times[i]);
    std::sort(tries_.begin(), tries_.end(), [](const auto& a, const auto& b) { return a->ms < b->ms; });
    for (const auto& t : tries_) {
      if (options_.by == PickBy::rmse) measure(*t, image_of(t->timed->plan(), t->variation.run_options()), true);
      picked_.finalists.push_back(*t);
    }
  }

  void choose() {
    const std::vector<Choice>& all = picked_.finalists;
    bool found = false;
    for (size_t i = 0; i < all.size(); ++i) {
      const bool fits = is_within(all[i], options_);
      const bool is_better = options_.budget ? off(all[i]) < off(all[picked_.best]) : false;  // they are sorted by time
      if (!fits || (found && !is_better)) continue;
      picked_.best = i;
      found = true;
    }
    if (found) return;
    if (options_.budget) {
      throw Error("--budget {:g}ms: nothing is that fast on this frame and device; the fastest is {} with {:.2f} ms",
                  *options_.budget, name_of(all.front().variation), all.front().ms);
    }
    const Choice& nearest =
        *std::min_element(all.begin(), all.end(), [&](const Choice& a, const Choice& b) { return off(a) < off(b); });
    throw Error("--error {:g}: nothing comes that near to {}; the nearest is {} with {:.4f}", *options_.error,
                picked_.truth, name_of(nearest.variation), off(nearest));
  }

  double off(const Choice& choice) const { return error_of(choice, options_.by); }

  const Subject& subject_;
  const PickOptions& options_;
  Device& device_;
  const std::vector<std::string> available_;
  const bool first_view_only_;
  const Foreground foreground_;
  Image truth_;
  std::vector<std::unique_ptr<Try>> tries_;
  double longest_try_ = 0;  ///< seconds
  Picked picked_;
};

}  // namespace

const char* name_of(PickBy by) {
  if (by == PickBy::flicker) return "flicker";
  return by == PickBy::ssim ? "SSIM" : by == PickBy::flip ? "FLIP" : "RMSE";
}

double error_of(const Choice& choice, PickBy by) {
  if (by == PickBy::ssim) return 1 - choice.ssim;
  return by == PickBy::flip ? choice.flip.value_or(1) : choice.rmse;
}

std::vector<size_t> finalists_of(const std::vector<Choice>& tries, const PickOptions& options) {
  const auto is_better = [&](size_t a, size_t b) {
    return options.budget ? error_of(tries[a], options.by) < error_of(tries[b], options.by) : tries[a].ms < tries[b].ms;
  };
  const auto is_nearer = [&](const Choice& a, const Choice& b) {
    return options.budget ? a.ms < b.ms : error_of(a, options.by) < error_of(b, options.by);
  };
  std::vector<size_t> within, doubtful;
  for (size_t i = 0; i < tries.size(); ++i) {
    if (is_within(tries[i], options))
      within.push_back(i);
    else if (options.budget && tries[i].ms <= *options.budget * doubt)
      doubtful.push_back(i);
  }
  std::sort(within.begin(), within.end(), is_better);
  const auto rest = within.begin() + std::min(within.size(), most_finalists / 2);
  doubtful.insert(doubtful.end(), rest, within.end());
  within.erase(rest, within.end());
  std::sort(doubtful.begin(), doubtful.end(), is_better);
  // At least one, to tell how far the bound is missed.
  const size_t nearest = size_t(std::min_element(tries.begin(), tries.end(), is_nearer) - tries.begin());
  std::vector<size_t> finalists = {nearest};
  for (const std::vector<size_t>* some : {&within, &doubtful}) {
    for (const size_t i : *some) {
      if (i != nearest && finalists.size() < most_finalists) finalists.push_back(i);
    }
  }
  return finalists;
}

Picked pick(const Subject& subject, const PickOptions& options, Device& device) {
  return Search(subject, options, device).run();
}

}  // namespace gloam::bench
