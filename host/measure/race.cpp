#include "measure/race.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"
#include "measure/baselines.h"
#include "measure/document.h"
#include "measure/intervals.h"
#include "measure/measures.h"
#include "measure/naive.h"

namespace gloam::bench {
namespace {

/// The technique that the native loop computes, and the preset with its number of samples.
constexpr const char *reference_technique = "hbao+", *reference_preset = "medium";

/// The reference of light-field displays: the same samples, through any projection.
constexpr const char* reference_of_displays = "lightfield-hbao+";

/// Number of rows that share one run of the baselines, so that the two times of a ratio are close together.
constexpr size_t group_size = 4;

constexpr const char* racer_prefix = "racer ";
std::string name_of(size_t racer) { return racer_prefix + std::to_string(racer); }

/// The parameters if a plan computes HBAO+ like the native loop; else null.
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

bool is_of_display(const Frame& frame) {
  return std::any_of(frame.views.begin(), frame.views.end(),
                     [](const View& view) { return view.camera && view.camera->slits; });
}

void add(Series& sum, const Series& ms) {
  sum.resize(ms.size());
  for (size_t round = 0; round < ms.size(); ++round) sum[round] += ms[round];
}

/// Time of a technique's own passes in each round, without preparation, filter and resampling.
Series own_passes(const TimedPlan& timed) {
  Series sum;
  for (size_t i = 0; i < timed.passes().size(); ++i) {
    if (is_own(timed, i)) add(sum, timed.passes()[i].ms);
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

/// Shares of the estimate, then of the other passes in order.
std::vector<Share> spent_on(const TimedPlan& timed, const Series& own_floor_ms) {
  const Series estimate = own_passes(timed);
  std::vector<Share> shares = split_estimate(median(estimate), ratio(own_floor_ms, estimate));
  for (size_t i = 0; i < timed.passes().size(); ++i) {
    const TimedPlan::Pass& pass = timed.passes()[i];
    if (!is_own(timed, i)) add(shares, pass.name, median(pass.ms));
  }
  double sum = 0;
  for (const Share& share : shares) sum += share.share;
  for (Share& share : shares) share.share /= sum;
  return shares;
}

/// Whether a racer runs like the baselines: at full resolution, in float, fast.
bool runs_as_baseline(const Variation& v) {
  return v.resolution == 1 && v.math == Math::fast && v.real == Real::float32 && v.storage == Storage::float32;
}

/// Whether a racer computes the same as the native loop, in the same way.
bool is_native(const Racer& racer) {
  const Variation& v = racer.variation;
  return v.technique->name == reference_technique && v.settings.empty() && runs_as_baseline(v) &&
         as_baseline(racer.timed->plan());
}

/// Whether all of a racer's own passes have naive kernels. False for sweeps over anything but numbers of samples: the kernels
/// take long.
bool has_naive_estimate(const Racer& racer) {
  const TimedPlan& timed = *racer.timed;
  for (const auto& [name, value] : racer.variation.settings) {
    if (name != "directions" && name != "steps") return false;
  }
  for (size_t i = 0; i < timed.passes().size(); ++i) {
    if (is_own(timed, i) && !naive_kernel_for(timed.plan().passes[i])) return false;
  }
  return runs_as_baseline(racer.variation);
}

size_t own_passes_in(const Plan& plan) {
  return size_t(std::count_if(plan.passes.begin(), plan.passes.end(),
                              [&](const PlannedPass& planned) { return planned.technique->name == plan.technique; }));
}

/// The gather floor samples around these alone.
size_t foreground_pixels(const Frame& frame) {
  const Channel& depth = frame.views.front().planes.at("depth").channels[0];
  size_t count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) count += std::isfinite(depth.at(x, y));
  }
  return count;
}

/// A part computed by naive kernels and by gloam, and their difference there.
AgainstNaive part_of(const char* name, const Channel& naive, const Plan& plan, const Frame& frame, Device& device) {
  const RunResult run = gloam::run(plan, frame, device);
  const Channel& ours = run.frame.views[0].planes.at(plan.outputs.front()).channels[0];
  return {.part = name,
          .mean_difference = mean_difference(naive, ours),
          .max_difference = greatest_difference(naive, ours)};
}

}  // namespace

std::vector<Share> split_estimate(double ms, double gathers) {
  if (gathers > 1) return {{"estimate, whose gathers alone take longer", ms}};
  return {{"gathers", gathers * ms}, {"arithmetic of the estimate", (1 - gathers) * ms}};
}

Race::Race(const Frame& frame, const std::string& holds, double radius, Device& device)
    : frame_(frame), holds_(holds), radius_(radius), device_(device) {}

Race::~Race() = default;

PlainFrame& Race::plain() {
  if (!plain_) plain_ = std::make_unique<PlainFrame>(frame_, device_);
  return *plain_;
}

void Race::enter(Racer& racer, bool with_floor) {
  const std::vector<std::string> available = planes_of(frame_);
  RunOptions options = racer.variation.run_options();
  racer.timed = std::make_unique<TimedPlan>(whole_plan(racer.variation, available, holds_), frame_, device_, options);
  options.gathers_only = true;
  if (with_floor)
    racer.gathers =
        std::make_unique<TimedPlan>(unfiltered_plan(racer.variation, available, holds_), frame_, device_, options);
  racers_.push_back(&racer);
}

void Race::run(const Rounds& rounds, const std::function<void(int done, int of)>& progress, bool with_naive) {
  if (!has_reference_) enter_reference();
  has_reference_ = true;
  const size_t before = groups_.size();
  naives_.resize(racers_.size());
  for (size_t i = before; i < racers_.size() && with_naive; ++i) enter_naive(i);
  const size_t groups = groups_so_far_ + (racers_.size() - before + group_size - 1) / group_size;
  first_view_.resize(groups);
  cpu_.resize(groups);
  series_.resize(groups);
  std::vector<Contender> contenders;
  std::vector<size_t> group_of;
  for (size_t first = before; first < racers_.size(); first += group_size) {
    const size_t end = std::min(first + group_size, racers_.size());
    groups_.resize(end, groups_so_far_);
    add_group(first, end, contenders);
    group_of.resize(contenders.size(), groups_so_far_++);
  }
  const auto is_enough = [&](const std::vector<Series>& ms) {
    return rounds.narrow > 0 && are_narrow(ms, contenders, group_of, rounds.narrow);
  };
  const std::vector<Series> ms = interleaved(contenders, rounds, is_enough, progress);
  for (size_t i = 0; i < contenders.size(); ++i) series_[group_of[i]][contenders[i].name] = ms[i];
  for (size_t i = before; i < racers_.size(); ++i) add_ratios(i);
}

/// Whether the ratio of each racer to the reference of its group has a narrow interval; without a reference its time.
bool Race::are_narrow(const std::vector<Series>& ms, const std::vector<Contender>& contenders,
                      const std::vector<size_t>& group_of, double narrow) const {
  std::map<size_t, const Series*> reference;
  for (size_t i = 0; i < contenders.size(); ++i) {
    if (contenders[i].name == reference_technique) reference[group_of[i]] = &ms[i];
  }
  for (size_t i = 0; i < contenders.size(); ++i) {
    if (contenders[i].name.rfind(racer_prefix, 0) != 0) continue;
    const auto known = reference.find(group_of[i]);
    if (!is_narrow_enough(known == reference.end() ? ms[i] : ratios_of_rounds(ms[i], *known->second), narrow))
      return false;
  }
  return true;
}

void Race::add_floor(Racer& racer, int rounds) {
  RunOptions options = racer.variation.run_options();
  options.gathers_only = true;
  racer.gathers = std::make_unique<TimedPlan>(unfiltered_plan(racer.variation, planes_of(frame_), holds_), frame_,
                                              device_, options);
  TimedPlan whole(whole_plan(racer.variation, planes_of(frame_), holds_), frame_, device_,
                  racer.variation.run_options());
  const std::vector<Series> ms =
      interleaved({{"", [&] { return whole.run(); }}, {"", [&] { return racer.gathers->run(); }}}, rounds);
  racer.own_floor_ms = own_passes(*racer.gathers);
  racer.to_own_floor = ratio(ms.front(), racer.own_floor_ms);
  racer.spent_on = spent_on(whole, racer.own_floor_ms);
}

void Race::add_group(size_t first, size_t end, std::vector<Contender>& contenders) {
  bool with_native = false;
  const size_t group = groups_so_far_;
  std::map<std::string, Series>& cpu = cpu_[group];
  for (size_t i = first; i < end; ++i) {
    contenders.push_back({name_of(i), [timed = racers_[i]->timed.get()] { return timed->run(); }});
    if (racers_[i]->gathers) contenders.push_back({"", [timed = racers_[i]->gathers.get()] { return timed->run(); }});
    if (naives_[i]) contenders.push_back({"", [naive = naives_[i].get()] { return naive->run(); }});
    with_native |= is_native(*racers_[i]);
  }
  if (reference_) {
    contenders.push_back({reference_technique, [this, &of_group = first_view_[group], &cpu] {
                            const double ms = reference_->run();
                            of_group.push_back(reference_->first_view_ms());
                            if (reference_->cpu_ms().empty()) return ms;
                            cpu[reference_technique].push_back(reference_->cpu_ms().back());
                            cpu["first view"].push_back(reference_->first_view_cpu_ms());
                            return ms;
                          }});
  }
  for (const Contender& each : common_) contenders.push_back(keeping_cpu_time(each, cpu[each.name]));
  if (with_native) contenders.insert(contenders.end(), loops_.begin(), loops_.end());
}

void Race::enter_reference() {
  const bool on_display = is_of_display(frame_);
  const std::string name = on_display ? reference_of_displays : reference_technique;
  if (on_display)
    notes_.push_back(
        fmt::format("on light-field displays ratios to HBAO+ are to {} {}, since {} cannot compute such views", name,
                    reference_preset, reference_technique));
  for (const Technique& t : registry()) {
    if (t.name == name) reference_variation_ = {&t, reference_preset, radius_};
  }
  if (!reference_variation_.technique) return;
  try {
    const Plan plan = whole_plan(reference_variation_, planes_of(frame_), holds_);
    if (const ParameterValues* values = as_baseline(plan)) enter_baselines(values->as<HbaoPlusParams>());
    reference_ = std::make_unique<TimedPlan>(plan, frame_, device_);
  } catch (const MissingPlanes&) {
  }
}

void Race::enter_baselines(const HbaoPlusParams& params) {
  if (frame_.views.size() != 1) return;
  const Frame& frame = plain().frame;
  const Plan estimate = unfiltered_plan(reference_variation_, planes_of(frame), holds_);
  const RunResult result = gloam::run(estimate, frame, device_);
  baselines_ =
      std::make_unique<Baselines>(device_, plain(), params, reference_technique,
                                  result.frame.views[0].planes.at(estimate.outputs.front()).channels[0], notes_);
  common_ = baselines_->floors();
  loops_ = baselines_->loops();
}

void Race::enter_naive(size_t index) {
  Racer& racer = *racers_[index];
  if (frame_.views.size() != 1 || frame_.views[0].camera->orthographic || !has_naive_estimate(racer)) return;
  const Frame& frame = plain().frame;
  const std::vector<std::string> available = planes_of(frame);
  const Plan whole = whole_plan(racer.variation, available, holds_);
  if (!has_naive(whole)) return;
  auto naive = std::make_unique<Naive>(whole, frame, plain().planes, device_);
  std::vector<AgainstNaive> parts;
  parts.push_back(part_of("estimate", naive->result(own_passes_in(whole) - 1),
                          unfiltered_plan(racer.variation, available, holds_), frame, device_));
  if (naive->passes() > own_passes_in(whole)) {
    parts.push_back({.part = "filter"});
    parts.push_back(part_of("both", naive->result(naive->passes() - 1), whole, frame, device_));
  }
  const double tolerance = naive_kernel_for(whole.passes.front())->tolerance;
  for (const AgainstNaive& part : parts) {
    if (!part.mean_difference || *part.mean_difference <= tolerance) continue;
    notes_.push_back(differs("naive kernel", racer.variation.technique->name, *part.mean_difference));
    return;
  }
  racer.against_naive = std::move(parts);
  naives_[index] = std::move(naive);
}

void Race::add_ratios(size_t index) {
  Racer& racer = *racers_[index];
  const std::map<std::string, Series>& series = series_[groups_[index]];
  const auto ratio_to = [&](const Series& ms, const char* contender) -> std::optional<double> {
    const auto known = series.find(contender);
    if (known == series.end()) return {};
    return ratio(ms, known->second);
  };
  std::map<std::string, Series>& cpu = cpu_[groups_[index]];
  const auto rounds_to = [&](const char* contender) -> RoundRatios {
    const auto known = series.find(contender);
    if (known == series.end()) return {};
    return {ratios_of_rounds(racer.ms, known->second), ratios_of_rounds(racer.cpu_ms, cpu[contender])};
  };
  racer.ms = series.at(name_of(index));
  racer.cpu_ms = racer.timed->cpu_ms();
  if (racer.gathers) {
    racer.own_floor_ms = own_passes(*racer.gathers);
    racer.to_own_floor = ratio(racer.ms, racer.own_floor_ms);
    racer.spent_on = spent_on(*racer.timed, racer.own_floor_ms);
  }
  racer.to_gather_floor = ratio_to(racer.ms, "gather floor");
  racer.to_copy_floor = ratio_to(racer.ms, "copy floor");
  racer.to_gather_floor_rounds = rounds_to("gather floor");
  racer.to_copy_floor_rounds = rounds_to("copy floor");
  racer.to_hbao_plus = ratio_to(racer.ms, reference_technique);
  racer.to_hbao_plus_rounds = rounds_to(reference_technique);
  if (racer.to_hbao_plus && makes_first_view_only(*racer.variation.technique)) {
    racer.to_hbao_plus = ratio(racer.ms, first_view_[groups_[index]]);
    racer.to_hbao_plus_rounds = {ratios_of_rounds(racer.ms, first_view_[groups_[index]]),
                                 ratios_of_rounds(racer.cpu_ms, cpu["first view"])};
  }
  if (const auto copy = series.find("copy floor"); copy != series.end()) racer.copy_floor_ms = median(copy->second);
  if (naives_[index]) add_naive_ratios(index);
  if (is_native(racer)) racer.to_native = ratio_to(own_passes(*racer.timed), "native");
}

Peaks Race::peaks() const {
  if (!baselines_) return {};
  const Frame& frame = plain_->frame;
  const Layout layout(frame.width(), frame.height());
  const auto per_second = [&](const char* contender, double work) -> std::optional<double> {
    Series all;
    for (const auto& of_group : series_) {
      if (const auto known = of_group.find(contender); known != of_group.end())
        all.insert(all.end(), known->second.begin(), known->second.end());
    }
    if (all.empty()) return {};
    return work / median(all) * 1e-6;  // from ms to 10^9 a second
  };
  return {per_second("copy floor", 8.0 * layout.pitch * layout.height),
          per_second("gather floor", double(directions * steps) * double(foreground_pixels(frame))),
          per_second("fma peak", baselines_->fma_operations())};
}

void Race::add_naive_ratios(size_t index) {
  Racer& racer = *racers_[index];
  const Naive& naive = *naives_[index];
  const std::vector<TimedPlan::Pass>& passes = racer.timed->passes();
  // The plan may begin with passes that make normals.
  const size_t before = passes.size() - naive.passes(), own = own_passes_in(racer.timed->plan());
  for (AgainstNaive& part : racer.against_naive) {
    Series ms, naive_ms;
    const size_t first = part.part == "filter" ? own : 0, end = part.part == "estimate" ? own : naive.passes();
    for (size_t i = first; i < end; ++i) {
      add(ms, passes[before + i].ms);
      add(naive_ms, naive.ms(i));
    }
    part.ms = times_of(ms);
    part.naive_ms = times_of(naive_ms);
    part.ratio = ratio(ms, naive_ms);
  }
}

}  // namespace gloam::bench
