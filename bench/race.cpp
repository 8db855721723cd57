#include "race.h"

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

}  // namespace

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

  std::vector<Contender> contenders() {
    std::vector<Contender> list = {{"gather floor", [this] { return gathers_.run(); }},
                                   {"copy floor", [this] { return copy_.run(); }}};
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
  racer.timed = std::make_unique<TimedPlan>(whole_plan(racer.variation, planes_of(frame_), holds_), frame_, device_);
  racers_.push_back(&racer);
  contenders_.push_back({"", [timed = racer.timed.get()] { return timed->run(); }});
}

void Race::run(int rounds, const std::function<void(int done, int of)>& progress) {
  enter_reference();
  const std::vector<Series> ms = interleaved(contenders_, rounds, progress);
  for (size_t i = 0; i < racers_.size(); ++i) racers_[i]->ms = ms[i];
  for (size_t i = 0; i < contenders_.size(); ++i) series_[contenders_[i].name] = ms[i];
  for (Racer* racer : racers_) add_ratios(*racer);
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
    contenders_.push_back({reference_technique, [this] { return reference_->run(); }});
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
  for (Contender& contender : baselines_->contenders()) contenders_.push_back(std::move(contender));
}

std::optional<double> Race::ratio_to(const Series& ms, const std::string& contender) const {
  const auto known = series_.find(contender);
  if (known == series_.end()) return {};
  return ratio(ms, known->second);
}

void Race::add_ratios(Racer& racer) const {
  racer.to_gather_floor = ratio_to(racer.ms, "gather floor");
  racer.to_copy_floor = ratio_to(racer.ms, "copy floor");
  racer.to_hbao_plus = ratio_to(racer.ms, reference_technique);
  if (racer.variation.technique->name != reference_technique || !as_baseline(racer.timed->plan())) return;
  for (const TimedPlan::Pass& pass : racer.timed->passes()) {
    if (pass.name != reference_pass) continue;
    racer.to_naive = ratio_to(pass.ms, "naive");
    racer.to_native = ratio_to(pass.ms, "native");
  }
}

}  // namespace gloam::bench
