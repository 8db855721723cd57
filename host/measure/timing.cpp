#include "measure/timing.h"

#include <algorithm>

namespace gloam::bench {

Contender keeping_cpu_time(Contender contender, Series& cpu) {
  contender.run = [run = contender.run, cpu_ms = contender.cpu_ms, &cpu] {
    const double ms = run();
    const std::optional<double> spent = cpu_ms ? cpu_ms() : std::nullopt;
    if (spent) cpu.push_back(*spent);
    return ms;
  };
  return contender;
}

std::vector<Series> interleaved(const std::vector<Contender>& contenders, const Rounds& rounds,
                                const std::function<bool(const std::vector<Series>&)>& is_enough,
                                const std::function<void(int, int)>& progress) {
  std::vector<Series> ms(contenders.size());
  const int of = rounds.most * int(contenders.size());
  int done = 0;
  for (int round = 1; round <= rounds.most; ++round) {
    for (size_t i = 0; i < contenders.size(); ++i) {
      ms[i].push_back(contenders[i].run());
      if (progress) progress(++done, of);
    }
    if (rounds.is_over && rounds.is_over()) break;
    if (round >= rounds.fewest && is_enough && is_enough(ms)) break;
  }
  return ms;
}

std::vector<Series> interleaved(const std::vector<Contender>& contenders, int rounds,
                                const std::function<void(int, int)>& progress) {
  return interleaved(contenders, Rounds{.fewest = rounds, .most = rounds}, {}, progress);
}

double ratio(const Series& a, const Series& b) {
  Series ratios;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) ratios.push_back(a[i] / b[i]);
  return median(std::move(ratios));
}

TimedPlan::TimedPlan(Plan plan, const Frame& frame, Device& device, const RunOptions& options)
    : plan_(std::move(plan)), frame_(frame), device_(device), options_(options) {
  // One untimed run takes the cost of fresh pages and cold caches; then two timed runs, of which the last counts. For long runs
  // that cost is negligible.
  constexpr double long_ms = 30;
  options_.repeat = 1;
  const RunResult first = gloam::run(plan_, frame_, device_, options_);
  lanes_ = first.lanes;
  options_.repeat = first.total_ms.back() > long_ms ? 1 : 2;
  for (const PlannedPass& planned : plan_.passes) passes_.push_back({planned.label(), {}});
}

double TimedPlan::run() {
  const RunResult result = gloam::run(plan_, frame_, device_, options_);
  for (Pass& pass : passes_) {
    double ms = 0;  // sum over the views that it ran on
    for (const PassTime& time : result.passes) {
      if (time.name != pass.name) continue;
      ms += time.ms.back();
      pass.of_views[time.view].push_back(time.ms.back());
    }
    pass.ms.push_back(ms);
  }
  first_view_ms_ = first_view_cpu_ms_ = 0;
  for (const PassTime& time : result.passes) {
    if (time.view != frame_.views.front().name) continue;
    first_view_ms_ += time.ms.back();
    if (!time.cpu_ms.empty()) first_view_cpu_ms_ += time.cpu_ms.back();
  }
  if (!result.total_cpu_ms.empty()) cpu_ms_.push_back(result.total_cpu_ms.back());
  return result.total_ms.back();
}

}  // namespace gloam::bench
