#include "race.h"

#include <algorithm>

#include "floors.h"
#include "gloam/error.h"
#include "measures.h"
#include "naive.h"
#include "native.h"

namespace gloam::bench {
namespace {

/// Above this mean absolute difference a baseline computes something else than gloam.
constexpr double baseline_tolerance = 1e-4;

/// What the baselines compute, and the preset with their number of samples.
constexpr const char *reference_technique = "hbao+", *reference_pass = "hbao+/estimate", *reference_preset = "medium";

/// So many rows share one run of what all are compared with, so that the two of a ratio are close in time.
constexpr size_t group_size = 4;

std::string name_of(size_t racer) { return "racer " + std::to_string(racer); }

/// The baselines' frame: one view's depth and normals, which are computed where the frame has none.
Frame depth_and_normals(const Frame& frame, Device& device) {
  Frame out = run(make_plan({.outputs = {"depth", "normal"}}, planes_of(frame), "the frame"), frame, device).frame;
  if (const Plane* given = frame.views.front().find("normal"))
    out.views.front().planes.insert_or_assign("normal", given->clone());
  return out;
}

/// HBAO+ as the baselines compute it; null where a plan does otherwise.
const ParameterValues* as_baseline(const Plan& plan) {
  const ParameterValues* values = values_of(plan, reference_technique);
  if (!values) return nullptr;
  const bool same = values->number("directions") == directions && values->number("steps") == steps &&
                    values->number("power") == 1 && values->text("falloff") == "quadratic" &&
                    values->text("jitter") == "on";
  return same ? values : nullptr;
}

bool is_own(const TimedPlan& timed, size_t pass) {
  const std::vector<PlannedPass>& passes = timed.plan().passes;
  return passes[pass].technique->name == timed.plan().technique;
}

/// A technique's own passes, without what prepares, filters or resamples: their time in each round.
Series own_passes(const TimedPlan& timed) {
  Series sum;
  for (size_t i = 0; i < timed.passes().size(); ++i) {
    if (!is_own(timed, i)) continue;
    const Series& ms = timed.passes()[i].ms;
    sum.resize(ms.size());
    for (size_t round = 0; round < ms.size(); ++round) sum[round] += ms[round];
  }
  return sum;
}

void add(std::vector<Share>& shares, const std::string& what, double ms) {
  for (Share& share : shares) {
    if (share.what != what) continue;
    share.share += ms;
    return;
  }
  shares.push_back({what, ms});
}

/// The estimate in two, gathers and the rest, then the other passes in their order.
std::vector<Share> spent_on(const Racer& racer) {
  const Series estimate = own_passes(*racer.timed);
  const double gathers = std::min(1.0, ratio(racer.own_floor_ms, estimate));
  std::vector<Share> shares = {{"gathers", gathers * median(estimate)},
                               {"arithmetic of the estimate", (1 - gathers) * median(estimate)}};
  for (size_t i = 0; i < racer.timed->passes().size(); ++i) {
    const TimedPlan::Pass& pass = racer.timed->passes()[i];
    if (!is_own(*racer.timed, i)) add(shares, pass.name, median(pass.ms));
  }
  double sum = 0;
  for (const Share& share : shares) sum += share.share;
  for (Share& share : shares) share.share /= sum;
  return shares;
}

}  // namespace

/// Whether a racer computes what the baselines compute, as they do.
bool is_baseline(const Racer& racer) {
  const Variation& v = racer.variation;
  return v.technique->name == reference_technique && v.settings.empty() && v.resolution == 1 && v.math == Math::fast &&
         v.real == Real::float32 && v.storage == Storage::float32 && as_baseline(racer.timed->plan());
}

/// What HBAO+ with 8 x 4 samples is measured against, and floors of the device.
class Race::Baselines {
 public:
  /// `estimate`: what gloam makes; a baseline that makes something else takes no part.
  Baselines(Device& device, const Frame& frame, const HbaoPlusParams& params, const Channel& estimate,
            std::vector<std::string>& notes)
      : notes_(notes),
        planes_(device, frame),
        gathers_(device, frame, planes_, params),
        copy_(device, frame, planes_),
        naive_(device, frame, planes_, params, Counts::at_run_time),
        native_(frame, params, widest_instructions()) {
    if (frame.views[0].camera->orthographic) return;
    naive_.run();
    has_naive_ = fits("naive", planes_.download(), estimate);
    native_.run();
    has_native_ = fits("native", native_.result(), estimate);
  }

  std::vector<Contender> floors() {
    return {{"gather floor", [this] { return gathers_.run(); }}, {"copy floor", [this] { return copy_.run(); }}};
  }

  std::vector<Contender> loops() {
    std::vector<Contender> list;
    if (has_naive_) list.push_back({"naive", [this] { return naive_.run(); }});
    if (has_native_) list.push_back({"native", [this] { return native_.run(); }});
    return list;
  }

 private:
  bool fits(const char* name, const Channel& ao, const Channel& estimate) {
    const double difference = mean_difference(ao, estimate);
    if (difference <= baseline_tolerance) return true;
    notes_.push_back(fmt::format("the {} loop differs from {} by {:.2g} on average: no ratio to it", name,
                                 reference_technique, difference));
    return false;
  }

  std::vector<std::string>& notes_;
  DevicePlanes planes_;
  GatherFloor gathers_;
  CopyFloor copy_;
  Naive naive_;
  Native native_;
  bool has_naive_ = false, has_native_ = false;
};

Race::Race(const Frame& frame, const std::string& holds, double radius, Device& device)
    : frame_(frame), holds_(holds), radius_(radius), device_(device) {}

Race::~Race() = default;

void Race::enter(Racer& racer) {
  const std::vector<std::string> available = planes_of(frame_);
  RunOptions options = racer.variation.run_options();
  racer.timed = std::make_unique<TimedPlan>(whole_plan(racer.variation, available, holds_), frame_, device_, options);
  options.gathers_only = true;
  racer.gathers =
      std::make_unique<TimedPlan>(unfiltered_plan(racer.variation, available, holds_), frame_, device_, options);
  racers_.push_back(&racer);
}

void Race::run(int rounds, const std::function<void(int done, int of)>& progress) {
  enter_reference();
  std::vector<Contender> contenders;
  std::vector<size_t> group_of;
  for (size_t first = 0; first < racers_.size(); first += group_size) {
    add_group(first, contenders);
    group_of.resize(contenders.size(), first / group_size);
  }
  const std::vector<Series> ms = interleaved(contenders, rounds, progress);
  series_.resize(group_of.empty() ? 0 : group_of.back() + 1);
  for (size_t i = 0; i < contenders.size(); ++i) series_[group_of[i]][contenders[i].name] = ms[i];
  for (size_t i = 0; i < racers_.size(); ++i) add_ratios(i);
}

void Race::add_group(size_t first, std::vector<Contender>& contenders) {
  bool with_baselines = false;
  for (size_t i = first; i < std::min(first + group_size, racers_.size()); ++i) {
    contenders.push_back({name_of(i), [timed = racers_[i]->timed.get()] { return timed->run(); }});
    contenders.push_back({"", [timed = racers_[i]->gathers.get()] { return timed->run(); }});
    with_baselines |= is_baseline(*racers_[i]);
  }
  contenders.insert(contenders.end(), common_.begin(), common_.end());
  if (with_baselines) contenders.insert(contenders.end(), loops_.begin(), loops_.end());
}

void Race::enter_reference() {
  for (const Technique& t : registry()) {
    if (t.name == reference_technique) reference_variation_ = {&t, reference_preset, radius_};
  }
  if (!reference_variation_.technique) return;
  try {
    const Plan plan = whole_plan(reference_variation_, planes_of(frame_), holds_);
    if (const ParameterValues* values = as_baseline(plan)) enter_baselines(values->as<HbaoPlusParams>());
    reference_ = std::make_unique<TimedPlan>(plan, frame_, device_);
    common_.push_back({reference_technique, [this] { return reference_->run(); }});
  } catch (const MissingPlanes&) {
  }
}

void Race::enter_baselines(const HbaoPlusParams& params) {
  if (frame_.views.size() != 1) return;
  plain_ = depth_and_normals(frame_, device_);
  const Plan estimate = unfiltered_plan(reference_variation_, planes_of(plain_), holds_);
  const RunResult result = gloam::run(estimate, plain_, device_);
  baselines_ = std::make_unique<Baselines>(
      device_, plain_, params, result.frame.views[0].planes.at(estimate.outputs.front()).channels[0], notes_);
  common_ = baselines_->floors();
  loops_ = baselines_->loops();
}

void Race::add_ratios(size_t index) {
  Racer& racer = *racers_[index];
  const std::map<std::string, Series>& series = series_[index / group_size];
  const auto ratio_to = [&](const Series& ms, const char* contender) -> std::optional<double> {
    const auto known = series.find(contender);
    if (known == series.end()) return {};
    return ratio(ms, known->second);
  };
  racer.ms = series.at(name_of(index));
  racer.own_floor_ms = own_passes(*racer.gathers);
  racer.to_own_floor = ratio(racer.ms, racer.own_floor_ms);
  racer.spent_on = spent_on(racer);
  racer.to_gather_floor = ratio_to(racer.ms, "gather floor");
  racer.to_copy_floor = ratio_to(racer.ms, "copy floor");
  racer.to_hbao_plus = ratio_to(racer.ms, reference_technique);
  if (!is_baseline(racer)) return;
  for (const TimedPlan::Pass& pass : racer.timed->passes()) {
    if (pass.name != reference_pass) continue;
    racer.to_naive = ratio_to(pass.ms, "naive");
    racer.to_native = ratio_to(pass.ms, "native");
  }
}

}  // namespace gloam::bench
