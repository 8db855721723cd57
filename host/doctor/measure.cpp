#include "doctor/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/run.h"
#include "stress/frames.h"
#include "stress/outputs.h"

namespace gloam::doctor {
namespace {

constexpr int timed_width = 960,
              timed_height = 540;  ///< on CPUs, groups of smaller images have one work-item (run/launch.cpp)
constexpr int rounds = 5;
constexpr double hopeless = 1.5;   ///< of the best time: after the first round, such a candidate drops out
constexpr double worth_it = 0.97;  ///< share of the usual tuning's time that another must not exceed to take its place

/// A candidate and its times: one for each round that it took part in.
struct Candidate {
  Tuning tuning;
  std::vector<double> ms;
  double best() const {
    return ms.empty() ? std::numeric_limits<double>::infinity() : *std::min_element(ms.begin(), ms.end());
  }
};

bool is_faster(const Candidate& a, const Candidate& b) { return a.best() < b.best(); }

/// Several rounds in which the candidates take turns: what disturbs one disturbs all. The first of them is the usual one.
std::vector<Candidate> times_of(const std::vector<Tuning>& tunings, const Plan& plan, const Frame& frame,
                                Device& device, const std::function<void()>& goes_on) {
  std::vector<Candidate> candidates;
  for (const Tuning& tuning : tunings) candidates.push_back({tuning, {}});
  for (int round = -1; round < rounds; ++round) {  // the first one compiles
    const double best = std::min_element(candidates.begin(), candidates.end(), is_faster)->best();
    for (Candidate& one : candidates) {
      if (!one.ms.empty() && one.best() > hopeless * best) continue;
      const RunResult result = run(plan, frame, device, {.lanes = one.tuning.lanes, .group = one.tuning.group});
      if (round >= 0) one.ms.push_back(result.total_ms.front());
      goes_on();
    }
  }
  return candidates;
}

/// Whether a candidate is faster than the usual one by more than noise: at its best, and in most rounds.
bool is_worth_it(const Candidate& one, const Candidate& usual) {
  const size_t common = std::min(one.ms.size(), usual.ms.size());
  size_t wins = 0;
  for (size_t i = 0; i < common; ++i) wins += one.ms[i] < worth_it * usual.ms[i];
  return one.best() < worth_it * usual.best() && 4 * wins > 3 * common;
}

/// The fastest that is worth it, else the usual one.
const Candidate& best_of(const std::vector<Candidate>& candidates) {
  const Candidate* best = &candidates.front();
  for (const Candidate& one : candidates) {
    if (is_worth_it(one, candidates.front()) && is_faster(one, *best)) best = &one;
  }
  return *best;
}

/// The usual number of lanes, and those next to it: what is further off has never been the fastest, and takes long to compile.
std::vector<Tuning> lane_candidates(const Tuning& usual) {
  const auto at = std::find(lane_widths.begin(), lane_widths.end(), usual.lanes);
  std::vector<Tuning> all = {usual};
  if (at != lane_widths.begin()) all.push_back({*(at - 1), usual.group});
  if (at != lane_widths.end() && at + 1 != lane_widths.end()) all.push_back({*(at + 1), usual.group});
  return all;
}

/// Without the driver's choice on CPUs: a CPU driver compiles a kernel for each size that it chooses.
std::vector<Tuning> group_candidates(const Tuning& best, bool is_cpu) {
  std::vector<Tuning> all = {best};
  for (const int group : is_cpu ? std::vector{4, 16, 64} : std::vector{0, 32, 64, 128, 256}) {
    if (group != best.group) all.push_back({best.lanes, group});
  }
  return all;
}

}  // namespace

Measurement measure_tuning(const std::string& technique, Device& device, const std::function<void()>& goes_on) {
  Frame frame = stress::shoot(stress::perspective(timed_width, timed_height), stress::room());
  const Plan plan = stress::plan_for(PlanRequest{.outputs = {technique}, .filter = "none"}, frame);
  const Tuning usual = device.info().usual;
  const std::vector<Candidate> by_lanes = times_of(lane_candidates(usual), plan, frame, device, goes_on);
  const Tuning best_lanes = best_of(by_lanes).tuning;
  const std::vector<Candidate> by_group =
      times_of(group_candidates(best_lanes, device.info().type == "cpu"), plan, frame, device, goes_on);
  Measurement measurement{.best = best_of(by_group).tuning};
  for (const Candidate& one : by_group) measurement.timed.push_back({one.tuning, one.best()});
  for (const Candidate& one : by_lanes) {
    if (one.tuning.lanes != best_lanes.lanes) measurement.timed.push_back({one.tuning, one.best()});
  }
  std::stable_sort(measurement.timed.begin(), measurement.timed.end(),
                   [](const Timed& a, const Timed& b) { return a.ms < b.ms; });
  return measurement;
}

}  // namespace gloam::doctor
