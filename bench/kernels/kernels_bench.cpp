// Every kernel of the registry by itself: one line per pass of a technique with default settings, for one lane and for the
// device's own width; kernels that read a stack of layers with 1, 2, 4 and 8 of them. A new technique is included by itself.
//
// bench_kernels [--size=WIDTHxHEIGHT]... [Google Benchmark's flags]      Default size: 1920x1080
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>

#include "base/lists.h"
#include "bench/bench_frame.h"
#include "bench/plans.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/run.h"

namespace gloam::bench {
namespace {

/// The inputs of a technique, with a number of layers for each stack.
std::vector<std::string> planes_read(const Technique& technique, int layers) {
  std::vector<std::string> planes;
  for (const std::string& plane : technique.reads) {
    if (!is_stack(plane)) planes.push_back(plane);
    for (int number = 0; is_stack(plane) && number < layers; ++number) planes.push_back(layer_name(plane, number));
  }
  return planes;
}

/// The technique alone: all its inputs are there, and nothing follows. None if it needs more layers than there are.
std::optional<Plan> plan_alone(const Technique& technique, float radius, int layers) {
  PlanRequest request{.outputs = {technique.name}, .then = "none"};
  for (const std::string& plane : technique.writes) {
    if (contains(outputs_of(technique), plane)) request.only.push_back(plane);
  }
  if (ParameterValues(technique.parameters).has("radius"))
    request.settings.emplace_back("radius", fmt::format("{}", radius));
  try {
    return make_plan(request, planes_read(technique, layers), "the benchmark's frame");
  } catch (const MissingPlanes&) {
    return {};
  }
}

/// One pass of the technique, with all its inputs in the frame.
Plan pass_alone(const Plan& technique, const PlannedPass& pass) {
  Plan plan;
  plan.technique = pass.label();
  plan.passes = {pass};
  for (const Binding& binding : pass.pass.reads) {
    const auto stack = technique.stacks.find(binding.plane);
    if (stack == technique.stacks.end()) {
      add_new(plan.inputs, binding.plane);
      continue;
    }
    plan.stacks.insert(*stack);
    for (const std::string& layer : stack->second) add_new(plan.inputs, layer);
  }
  return plan;
}

/// 0 if it reads no stack.
std::vector<int> layer_counts(const Technique& technique) {
  return reads_layers(technique) ? std::vector<int>{1, 2, 4, most_layers} : std::vector<int>{0};
}

double seconds(const Plan& plan, const Frame& frame, Device& device, int lanes, int runs) {
  RunOptions options;
  options.lanes = lanes;
  options.repeat = runs + 1;
  const std::vector<double> ms = run(plan, frame, device, options).total_ms;
  return std::accumulate(ms.begin() + 1, ms.end(), 0.0) * 1e-3;  // the first run warms up
}

/// Many runs for each call of run(), which takes far longer than a kernel to check and copy the planes.
void measure(benchmark::State& state, const Plan& plan, const Frame& frame, Device& device, int lanes) {
  constexpr double seconds_a_call = 0.05;
  constexpr int most_runs = 200;
  try {
    const double once = seconds(plan, frame, device, lanes, 1);
    const int runs = static_cast<int>(std::clamp(seconds_a_call / once, 1.0, double{most_runs}));
    while (state.KeepRunningBatch(runs)) state.SetIterationTime(seconds(plan, frame, device, lanes, runs));
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void add_benchmark(const Plan& plan, Frame& frame, Device& device, int lanes, int layers) {
  for (const std::string& plane : plan.inputs) add_plane(frame, plane);
  const std::string name = fmt::format("{}/lanes:{}{}/{}", plan.technique, lanes,
                                       layers == 0 ? "" : fmt::format("/layers:{}", layers), size_name(frame));
  benchmark::RegisterBenchmark(
      name.c_str(),
      [plan, &frame, &device, lanes](benchmark::State& state) { measure(state, plan, frame, device, lanes); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_benchmarks(const Technique& technique, Frame& frame, Device& device, float radius) {
  std::vector<int> widths = {1};
  if (device.info().lanes != 1) widths.push_back(device.info().lanes);
  for (const int layers : layer_counts(technique)) {
    const std::optional<Plan> plan = plan_alone(technique, radius, layers);
    if (!plan) continue;
    for (const PlannedPass& pass : plan->passes) {
      for (const int lanes : widths) add_benchmark(pass_alone(*plan, pass), frame, device, lanes, layers);
    }
  }
}

int bench_main(int argc, char** argv) {
  std::vector<std::pair<int, int>> sizes = {{1920, 1080}};
  CLI::App flags;
  add_sizes(flags, sizes);
  take_flags(flags, argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Device device;
  std::vector<std::unique_ptr<Frame>> frames;
  for (const auto& [width, height] : sizes) {
    frames.push_back(std::make_unique<Frame>(loggia_frame(width, height)));
    const float radius = radius_reaching(*frames.back(), reach_in_full_hd * width / 1920);
    for (const Technique& technique : registry()) add_benchmarks(technique, *frames.back(), device, radius);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  return gloam::bench::run_program("bench_kernels", argc, argv, gloam::bench::bench_main);
}
