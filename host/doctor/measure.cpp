#include "doctor/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/lists.h"
#include "gloam/run.h"
#include "run/device_impl.h"
#include "run/tuning.h"
#include "stress/frames.h"
#include "stress/outputs.h"

namespace gloam::doctor {
namespace {

constexpr int timed_width = 1024,
              timed_height = 540;  ///< on CPUs, groups of smaller images have one work-item (run/launch.cpp)
constexpr int rounds = 5;
constexpr size_t least_rounds = 3;  ///< of a candidate that takes the usual one's place
constexpr double hopeless = 1.5;    ///< of the best time: after the first round, such a candidate drops out
constexpr double worth_it = 0.97;   ///< share of the usual tuning's time that another must not exceed to take its place
/// The technique whose kernel needs the most registers (bench/README.md, instructions on GPUs).
constexpr const char* needs_most_registers = "evidence";

using Times = std::vector<double>;

/// A candidate and its times: one for each round that it took part in, of either kind of kernel.
struct Candidate {
  Tuning tuning;
  Times search, others;
};

double best(const Times& times) {
  return times.empty() ? std::numeric_limits<double>::infinity() : *std::min_element(times.begin(), times.end());
}

/// Of all kernels.
double best(const Candidate& one) { return best(one.search) + best(one.others); }

/// While it lives, a device runs with another tuning.
class Tuned {
 public:
  Tuned(Device& device, const Tuning& tuning) : info_(device.impl().info), before_(info_.tuning) {
    info_.tuning = tuning;
  }
  ~Tuned() { info_.tuning = before_; }

 private:
  DeviceInfo& info_;
  Tuning before_;
};

void add_times(const RunResult& result, const Plan& plan, Candidate& candidate) {
  double search = 0, others = 0;
  for (size_t k = 0; k < result.passes.size(); ++k)
    (plan.passes[k].pass.footprint.is_wide ? search : others) += result.passes[k].ms.front();
  candidate.search.push_back(search);
  candidate.others.push_back(others);
}

/// Several rounds in which the candidates take turns: what disturbs one disturbs all. The first of them is the usual one.
std::vector<Candidate> times_of(const std::vector<Tuning>& tunings, const Plan& plan, const Frame& frame,
                                Device& device, const std::function<void()>& goes_on) {
  std::vector<Candidate> candidates;
  for (const Tuning& tuning : tunings) candidates.push_back({tuning, {}, {}});
  for (int round = -1; round < rounds; ++round) {  // the first one compiles
    double fastest = std::numeric_limits<double>::infinity();
    for (const Candidate& one : candidates) fastest = std::min(fastest, best(one));
    for (Candidate& one : candidates) {
      if (!one.search.empty() && best(one) > hopeless * fastest) continue;
      const Tuned tuned(device, one.tuning);
      const RunResult result = run(plan, frame, device);
      if (round >= 0) add_times(result, plan, one);
      goes_on();
    }
  }
  return candidates;
}

/// Whether times are shorter than the usual ones by more than noise: at their best, and in most rounds.
bool is_worth_it(const Times& times, const Times& usual) {
  const size_t common = std::min(times.size(), usual.size());
  size_t wins = 0;
  for (size_t i = 0; i < common; ++i) wins += times[i] < worth_it * usual[i];
  return common >= least_rounds && best(times) < worth_it * best(usual) && 4 * wins > 3 * common;
}

/// The candidate whose times of a kind are the shortest and worth it, else the usual one.
const Tuning& best_by(Times Candidate::*kind, const std::vector<Candidate>& candidates) {
  const Candidate* fastest = &candidates.front();
  for (const Candidate& one : candidates) {
    if (is_worth_it(one.*kind, candidates.front().*kind) && best(one.*kind) < best(fastest->*kind)) fastest = &one;
  }
  return fastest->tuning;
}

/// The usual number of lanes, and those next to it: what is further off has never been the fastest, and takes long to compile.
std::vector<Tuning> lane_candidates(const Tuning& usual) {
  const auto at = std::find(lane_widths.begin(), lane_widths.end(), usual.lanes);
  std::vector<Tuning> all = {usual};
  const auto add = [&](int lanes) { all.push_back({lanes, usual.search, usual.others, usual.gathers_by_loads}); };
  if (at != lane_widths.begin()) add(*(at - 1));
  if (at != lane_widths.end() && at + 1 != lane_widths.end()) add(*(at + 1));
  return all;
}

/// Without the driver's choice on CPUs: a CPU driver compiles a kernel for each size that it chooses.
std::vector<Tuning> group_candidates(const Tuning& best, bool is_cpu) {
  std::vector<Tuning> all = {best};
  for (const int group : is_cpu ? std::vector{4, 16, 32} : std::vector{0, 32, 64, 128, 256}) {
    if (group == best.search.group && group == best.others.group) continue;
    Tuning other = best;
    other.search.group = other.others.group = group;
    all.push_back(other);
  }
  return all;
}

/// A limit that a kernel does not reach changes nothing; one far below makes it keep values in memory.
std::vector<Tuning> register_candidates(const Tuning& best) {
  std::vector<Tuning> all = {best};
  for (const int registers : {0, 48, 64, 80, 96}) {
    if (registers == best.search.registers) continue;
    all.push_back(best);
    all.back().search.registers = registers;
  }
  return all;
}

/// Where kernels do not know it, both take the same time, and the usual one stays.
std::vector<Tuning> gather_candidates(const Tuning& best) {
  Tuning other = best;
  other.gathers_by_loads = !best.gathers_by_loads;
  return {best, other};
}

void add_timed(const std::vector<Candidate>& candidates, Measurement& measurement) {
  for (const Candidate& one : candidates) measurement.timed.push_back({one.tuning, best(one.search), best(one.others)});
}

}  // namespace

nlohmann::ordered_json document_of(const Timed& timed) {
  nlohmann::ordered_json document = gloam::document_of(timed.tuning);
  document["ms"] = timed.ms;
  document["ms_of_others"] = timed.ms_of_others;
  return document;
}

Measurement measure_tuning(const std::string& technique, Device& device, const std::function<void()>& goes_on) {
  Frame frame = stress::shoot(stress::perspective(timed_width, timed_height), stress::room());
  const Plan plan = stress::plan_for(PlanRequest{.outputs = {technique}}, frame);
  const Tuning usual = device.info().usual;
  Measurement measurement;
  Tuning& best = measurement.best;
  const std::vector<Candidate> by_lanes = times_of(lane_candidates(usual), plan, frame, device, goes_on);
  best = best_by(&Candidate::search, by_lanes);
  const std::vector<Candidate> by_group =
      times_of(group_candidates(best, device.info().type == "cpu"), plan, frame, device, goes_on);
  best.search = best_by(&Candidate::search, by_group).search;
  best.others = best_by(&Candidate::others, by_group).others;
  add_timed(by_group, measurement);
  for (const Candidate& one : by_lanes) {
    if (one.tuning.lanes != best.lanes) add_timed({one}, measurement);
  }
  if (best.lanes == 16)
    best.gathers_by_loads =
        best_by(&Candidate::search, times_of(gather_candidates(best), plan, frame, device, goes_on)).gathers_by_loads;
  std::stable_sort(measurement.timed.begin(), measurement.timed.end(),
                   [](const Timed& a, const Timed& b) { return a.ms + a.ms_of_others < b.ms + b.ms_of_others; });
  if (usual.search.registers > 0 && contains(technique_names(), needs_most_registers)) {
    const Plan most = stress::plan_for(PlanRequest{.outputs = {needs_most_registers}}, frame);
    best.search = best_by(&Candidate::search, times_of(register_candidates(best), most, frame, device, goes_on)).search;
  }
  return measurement;
}

}  // namespace gloam::doctor
