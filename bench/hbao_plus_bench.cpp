// HBAO+ 8 x 4 against its baselines, in one process: the naive kernel, a native loop, and floors of the device.
//
// bench_hbao_plus [--size=WIDTHxHEIGHT]... [--no_table] [--no_naive] [Google Benchmark's flags]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "bench/bench_frame.h"
#include "gloam/error.h"
#include "gloam/run.h"
#include "measure/floors.h"
#include "measure/measures.h"
#include "measure/naive.h"
#include "measure/native.h"
#include "measure/timing.h"

namespace gloam::bench {
namespace {

constexpr int rounds = 15;

Plan hbao_plus_plan(const Frame& frame, float radius) {
  PlanRequest request{.outputs = {"hbao+"}, .only_outputs = {"ao_raw"}, .filter = "none"};
  request.settings = {{"radius", fmt::format("{}", radius)},
                      {"directions", std::to_string(directions)},
                      {"steps", std::to_string(steps)},
                      {"power", "1"}};
  std::vector<std::string> available;
  for (const auto& [name, plane] : frame.views[0].planes) available.push_back(name);
  return make_plan(request, available, "the benchmark's frame");
}

/// All contenders at one size.
class Arena {
 public:
  Arena(Device& device, int width, int height, bool with_naive)
      : device_(device), frame_(loggia_frame(width, height)), planes_(device, frame_) {
    params_.radius = radius_reaching(frame_, reach_in_full_hd * width / 1920);
    params_.directions = directions;
    params_.steps = steps;
    plan_ = hbao_plus_plan(frame_, params_.radius);
    add_gloam("gloam fast", Math::fast);
    add_gloam("gloam precise", Math::precise);
    if (with_naive) {
      add_naive("naive", Counts::at_run_time);
      add_naive("naive unrolled", Counts::unrolled);
    }
    add_native();
    auto gathers = std::make_shared<GatherFloor>(device_, frame_, planes_, params_);
    auto copy = std::make_shared<CopyFloor>(device_, frame_, planes_);
    contenders_.push_back({"gather floor", [gathers] { return gathers->run(); }});
    contenders_.push_back({"copy floor", [copy] { return copy->run(); }});
  }

  const std::vector<Contender>& contenders() const { return contenders_; }
  std::string size() const { return size_name(frame_); }

 private:
  void add_gloam(const std::string& name, Math math) {
    RunOptions options;
    options.math = math;
    Channel ao = std::move(run(plan_, frame_, device_, options).frame.views[0].planes.at("ao_raw").channels[0]);
    if (math == Math::fast) {
      expected_ = std::move(ao);
    } else {
      check(name, ao);
    }
    auto timed = std::make_shared<TimedPlan>(plan_, frame_, device_, options);
    contenders_.push_back({name, [timed] { return timed->run(); }});
  }

  void add_naive(const std::string& name, Counts counts) {
    auto naive = std::make_shared<Naive>(plan_, frame_, planes_, device_, counts);
    check(name, naive->result(0));
    contenders_.push_back({name, [naive] { return naive->run(); }});
  }

  /// Checks every instruction set of this CPU; the widest competes.
  void add_native() {
    for (const Instructions i : {Instructions::scalar, Instructions::avx2, Instructions::avx512}) {
      if (i > widest_instructions()) continue;
      for (const bool tuned : {false, true}) {
        auto native = std::make_shared<Native>(frame_, params_, i, tuned);
        native->run();
        const std::string name = tuned ? "native tuned" : "native";
        check(fmt::format("{} {}", name, name_of(i)), native->result());
        if (i == widest_instructions()) contenders_.push_back({name, [native] { return native->run(); }});
      }
    }
  }

  /// Throws Error if a baseline computes something else.
  void check(const std::string& name, const Channel& ao) const {
    const double mean = mean_difference(ao, expected_);
    std::fprintf(stderr, "%s %s: mean absolute difference from gloam %.2e\n", size().c_str(), name.c_str(), mean);
    if (!(mean <= 1e-4)) throw Error("{} differs from gloam by {:.2e} on average; 1e-4 allowed", name, mean);
  }

  Device& device_;
  Frame frame_;
  DevicePlanes planes_;
  HbaoPlusParams params_;
  Plan plan_;
  Channel expected_;
  std::vector<Contender> contenders_;
};

void add_benchmarks(const Arena& arena) {
  for (const Contender& contender : arena.contenders()) {
    std::string name = fmt::format("hbao+ 8x4/{}/{}", contender.name, arena.size());
    std::replace(name.begin(), name.end(), ' ', '_');
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&contender](benchmark::State& state) {
                                   for (auto _ : state) state.SetIterationTime(contender.run() * 1e-3);
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

void print_table(std::FILE* out, const Arena& arena) {
  const std::vector<Series> ms = interleaved(arena.contenders(), rounds);
  fmt::print(out, "\n{}, {} interleaved rounds (ms)\n", arena.size(), rounds);
  fmt::print(out, "| {:<15} | median |    min |    max | gloam fast / this | gloam precise / this |\n", "");
  fmt::print(out, "|-----------------|--------|--------|--------|-------------------|----------------------|\n");
  for (size_t i = 0; i < ms.size(); ++i) {
    const auto [low, high] = std::minmax_element(ms[i].begin(), ms[i].end());
    fmt::print(out, "| {:<15} | {:6.1f} | {:6.1f} | {:6.1f} | {:17.3f} | {:20.3f} |\n", arena.contenders()[i].name,
               median(ms[i]), *low, *high, ratio(ms[0], ms[i]), ratio(ms[1], ms[i]));
  }
  std::fflush(out);
}

bool writes_data_to_stdout(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const std::string& argument) {
    return argument == "--benchmark_format=json" || argument == "--benchmark_format=csv";
  });
}

int bench_main(int argc, char** argv) {
  bool no_table = false, no_naive = false;
  std::vector<std::pair<int, int>> sizes = {{1920, 1080}};
  take_flags(argc, argv, sizes, {{"--no_table", &no_table}, {"--no_naive", &no_naive}});
  std::FILE* const table_out = writes_data_to_stdout(argc, argv) ? stderr : stdout;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Device device;
  std::vector<std::unique_ptr<Arena>> arenas;
  for (const auto& [width, height] : sizes) {
    arenas.push_back(std::make_unique<Arena>(device, width, height, !no_naive));
  }
  for (const auto& arena : arenas) add_benchmarks(*arena);
  benchmark::RunSpecifiedBenchmarks();
  if (!no_table) {
    for (const auto& arena : arenas) print_table(table_out, *arena);
  }
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  return gloam::bench::run_program("bench_hbao_plus", argc, argv, gloam::bench::bench_main);
}
