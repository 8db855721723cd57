// The cost of denormal numbers: every technique with default settings on a frame in closed form, compared with the same frame in
// a unit so large that its depths are denormal; and with a denormal depth in one pixel of 16, compared with tiny but normal
// depths there. A new technique is included by itself.
//
// bench_denormals [--size=WIDTHxHEIGHT]... [TECHNIQUE]...     Default size: 960x540
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/low_discrepancy.h"
#include "bench/bench_frame.h"
#include "gloam/device.h"
#include "gloam/error.h"
#include "measure/timing.h"
#include "stress/frames.h"
#include "stress/outputs.h"

namespace gloam::bench {
namespace {

constexpr int rounds = 9;
/// Depths of 1 to 4 become 2e-40 to 7e-40; float is denormal below 1.2e-38.
constexpr int denormal_unit = -132, tiny_unit = -100;

/// One pixel in 16 has the depth 2^k.
Frame with_holes(const Frame& usual, int k) {
  Frame frame = stress::clone(usual);
  for (View& view : frame.views) {
    Channel& depth = view.planes.at("depth").channels[0];
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        if (hash(uint32_t(y * frame.width() + x)) % 16 == 0) depth.at(x, y) = std::ldexp(1.0f, k);
      }
    }
  }
  return frame;
}

struct Ratios {
  double ms, everywhere, holes;
};

Ratios measure(const Technique& technique, const stress::Shot& shot, Device& device) {
  Frame usual = stress::shoot(shot, stress::room());
  const Plan plan = stress::plan_for(technique, usual);  // adds invented planes
  Frame denormal = stress::in_other_unit(usual, denormal_unit);
  const auto lengths = stress::set_lengths(technique, denormal, [](double l) { return std::ldexp(l, denormal_unit); });
  const Frame tiny_holes = with_holes(usual, tiny_unit), holes = with_holes(usual, denormal_unit);
  TimedPlan first(plan, usual, device), second(stress::plan_for(technique, denormal, lengths), denormal, device),
      third(plan, tiny_holes, device), fourth(plan, holes, device);
  const std::vector<Series> ms = interleaved({{"usual", [&] { return first.run(); }},
                                              {"denormal", [&] { return second.run(); }},
                                              {"tiny holes", [&] { return third.run(); }},
                                              {"denormal holes", [&] { return fourth.run(); }}},
                                             rounds);
  return {median(ms[0]), ratio(ms[1], ms[0]), ratio(ms[3], ms[2])};
}

std::vector<const Technique*> chosen(int argc, char** argv) {
  std::vector<const Technique*> techniques;
  for (int i = 1; i < argc; ++i) techniques.push_back(&find_technique(argv[i]));
  for (const Technique& technique : registry()) {
    if (argc == 1) techniques.push_back(&technique);
  }
  return techniques;
}

int bench_main(int argc, char** argv) {
  std::vector<std::pair<int, int>> sizes = {{960, 540}};
  take_flags(argc, argv, sizes);
  const std::vector<const Technique*> techniques = chosen(argc, argv);
  Device device;
  for (const auto& [width, height] : sizes) {
    fmt::print("{}x{}, {} interleaved rounds\n", width, height, rounds);
    fmt::print("| technique           |       ms | all denormal / usual | one pixel of 16, denormal / tiny |\n");
    fmt::print("|---------------------|----------|----------------------|----------------------------------|\n");
    for (const Technique* technique : techniques) {
      const Ratios r = measure(*technique, stress::perspective(width, height), device);
      fmt::print("| {:<19} | {:8.2f} | {:20.2f} | {:32.2f} |\n", "`" + technique->name + "`", r.ms, r.everywhere,
                 r.holes);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  return gloam::bench::run_program("bench_denormals", argc, argv, gloam::bench::bench_main);
}
