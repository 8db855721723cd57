// Every technique of the registry with each of its presets, at one lane and at the device's own width. A new technique
// appears by itself.
//
// bench_techniques [--size=WIDTHxHEIGHT]... [Google Benchmark's flags]      Default size: 1920x1080
#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>

#include "bench_frame.h"
#include "gloam/error.h"
#include "gloam/run.h"

namespace gloam::bench {
namespace {

constexpr double reach_in_full_hd = 60;  ///< pixels, median; for techniques with a radius

/// The technique alone: all it reads is there, nothing follows.
Plan plan_alone(const Technique& technique, const std::string& preset, float radius) {
  PlanRequest request{.outputs = {technique.name}, .only = technique.writes, .then = "none", .preset = preset};
  if (ParameterValues(technique.parameters).has("radius")) {
    request.settings.emplace_back("radius", fmt::format("{}", radius));
  }
  return make_plan(request, technique.reads, "the benchmark's frame");
}

std::vector<std::string> presets_of(const Technique& technique) {
  std::vector<std::string> names;
  for (const Preset& preset : technique.presets) names.push_back(preset.name);
  return names.empty() ? std::vector<std::string>{""} : names;
}

void measure(benchmark::State& state, const Plan& plan, const Frame& frame, Device& device, int lanes) {
  RunOptions options;
  options.lanes = lanes;
  options.repeat = 2;
  try {
    for (auto _ : state) state.SetIterationTime(run(plan, frame, device, options).total_ms.back() * 1e-3);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void add_benchmarks(const Technique& technique, const Frame& frame, Device& device, float radius) {
  std::vector<int> widths = {1};
  if (device.info().lanes != 1) widths.push_back(device.info().lanes);
  for (const std::string& preset : presets_of(technique)) {
    const Plan plan = plan_alone(technique, preset, radius);
    for (const int lanes : widths) {
      const std::string name = fmt::format("{}/{}/lanes:{}/{}", technique.name, preset.empty() ? "default" : preset,
                                           lanes, size_name(frame));
      benchmark::RegisterBenchmark(
          name.c_str(),
          [plan, &frame, &device, lanes](benchmark::State& state) { measure(state, plan, frame, device, lanes); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
}

int bench_main(int argc, char** argv) {
  const auto sizes = take_sizes(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Device device;
  std::vector<std::unique_ptr<Frame>> frames;
  for (const auto& [width, height] : sizes) {
    frames.push_back(std::make_unique<Frame>(loggia_frame(width, height)));
    Frame& frame = *frames.back();
    const float radius = radius_reaching(frame, reach_in_full_hd * width / 1920);
    for (const Technique& technique : registry()) {
      for (const std::string& plane : technique.reads) add_plane(frame, plane);
      add_benchmarks(technique, frame, device, radius);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  gloam::bench::make_openmp_wait_passively(argv);
  try {
    return gloam::bench::bench_main(argc, argv);
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "bench_techniques: %s\n", error.what());
    return error.exit_status();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_techniques: %s\n", error.what());
    return 1;
  }
}
