// Every kernel of the registry: one line per pass of a technique with default settings, for one lane and for the device's own
// width; kernels that read a stack of layers with 1, 2, 4 and 8 of them. A line is the median of 5 to 101 runs of the technique,
// by the device's clock. A new technique is included by itself.
//
// bench_kernels [--size=WIDTHxHEIGHT]... [Google Benchmark's flags]      Default size: 1920x1080
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "base/lists.h"
#include "base/statistics.h"
#include "bench/bench_frame.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "gloam/run.h"
#include "measure/plans.h"

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
  PlanRequest request{.outputs = {technique.name}, .filter = "none"};
  for (const std::string& plane : technique.writes) {
    if (contains(outputs_of(technique), plane)) request.only_outputs.push_back(plane);
  }
  if (const std::string name = radius_parameter(technique.parameters); !name.empty())
    request.settings.emplace_back(name, fmt::format("{}", radius));
  try {
    return make_plan(request, planes_read(technique, layers), "the benchmark's frame");
  } catch (const MissingPlanes&) {
    return {};
  }
}

/// 0 if it reads no stack.
std::vector<int> layer_counts(const Technique& technique) {
  return reads_layers(technique) ? std::vector<int>{1, 2, 4, most_layers} : std::vector<int>{0};
}

/// Milliseconds of a pass, in the middle of the plan's runs: mean over the views that run it. None if no view does.
std::optional<double> pass_ms(const RunResult& result, const std::string& pass) {
  double sum = 0;
  int views = 0;
  for (const PassTime& time : result.passes) {
    if (time.name != pass) continue;
    sum += median(time.ms);
    ++views;
  }
  if (views == 0) return {};
  return sum / views;
}

/// The pass runs within its plan, since it may read what only the passes before it can make: lists of pixels, coarse levels.
void measure(benchmark::State& state, const Plan& plan, const std::string& pass, const Frame& frame, Device& device,
             int lanes) {
  constexpr double ms_in_all = 200;
  RunOptions options;
  options.lanes = lanes;
  try {
    const double once = run(plan, frame, device, options).total_ms.front();
    options.repeat = static_cast<int>(std::clamp(ms_in_all / once, 5.0, 101.0));
    for (auto _ : state) {
      const std::optional<double> ms = pass_ms(run(plan, frame, device, options), pass);
      if (!ms) return state.SkipWithError("no view runs this pass");
      state.SetIterationTime(*ms * 1e-3);
    }
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void add_benchmark(const Plan& plan, const std::string& pass, const Frame& frame, Device& device, int lanes,
                   int layers) {
  const std::string name = fmt::format("{}/lanes:{}{}/{}", pass, lanes,
                                       layers == 0 ? "" : fmt::format("/layers:{}", layers), size_name(frame));
  benchmark::RegisterBenchmark(name.c_str(),
                               [plan, pass, &frame, &device, lanes](benchmark::State& state) {
                                 measure(state, plan, pass, frame, device, lanes);
                               })
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

void add_benchmarks(const Technique& technique, Frame& frame, Device& device, float radius) {
  std::vector<int> widths = {1};
  if (device.info().tuning.lanes != 1) widths.push_back(device.info().tuning.lanes);
  for (const int layers : layer_counts(technique)) {
    const std::optional<Plan> plan = plan_alone(technique, radius, layers);
    if (!plan) continue;
    for (const std::string& plane : plan->inputs) add_plane(frame, plane);
    std::set<std::string> passes;
    for (const PlannedPass& pass : plan->passes) {
      if (!passes.insert(pass.label()).second) continue;
      for (const int lanes : widths) add_benchmark(*plan, pass.label(), frame, device, lanes, layers);
    }
  }
}

int bench_main(int argc, char** argv) {
  std::vector<std::pair<int, int>> sizes = {{1920, 1080}};
  take_flags(argc, argv, sizes);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Device device;
  std::vector<std::unique_ptr<Frame>> frames;
  for (const auto& [width, height] : sizes) {
    Frame& mono = *frames.emplace_back(std::make_unique<Frame>(loggia_frame(width, height)));
    Frame& stereo = *frames.emplace_back(std::make_unique<Frame>(loggia_stereo_frame(width, height)));
    const float radius = radius_reaching(mono, reach_in_full_hd * width / 1920);
    for (const Technique& technique : registry())
      add_benchmarks(technique, technique.views == 2 ? stereo : mono, device, radius);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  return gloam::bench::run_program("bench_kernels", argc, argv, gloam::bench::bench_main);
}
