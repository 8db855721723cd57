// Hard cases 13 and 14: the same image from every lane width and every device; errors of float and of fast mathematics.
#include <algorithm>
#include <cmath>

#include "stress/case.h"
#include "stress/frames.h"
#include "technique/kernel_sources.h"

namespace gloam::stress {
namespace {

/// Whether the result of a plan may change with the seed.
bool uses_seed(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    const auto& defines = planned.pass.defines;
    const bool is_still =
        std::find(defines.begin(), defines.end(), std::pair<std::string, int>("JITTER", 0)) != defines.end();
    if (!is_still && flatten(source_of(*planned.technique, planned.pass)).find("frame.seed") != std::string::npos)
      return true;
  }
  return false;
}

void one_seed_one_image(Probe& probe) {
  const Settings few = few_samples(probe.technique());
  for (const Shot& shot : odd_shots()) {
    for (const Math math : {Math::precise, Math::fast}) {
      const auto way = [&](int seed) { return RunOptions{.math = math, .seed = seed}; };
      if (!probe.tries(fmt::format("seeds 5, 5 and 6, {}, {}", text_of(shot.camera), text_of(way(5))))) continue;
      Frame frame = shoot(shot, room(), false);
      const Frame first = probe.outputs(frame, few, way(5));
      probe.measure_bits("difference from run to run with one seed", probe.outputs(frame, few, way(5)), first);
      const bool changes = !same_bits(first, probe.outputs(frame, few, way(6)));
      probe.measure("images that do not change with the seed, or do and should not",
                    changes != uses_seed(plan_for(probe.technique(), frame)), 0);
    }
  }
}

/// The difference to judge between lane widths and devices in fast mathematics: the largest, or the mean if the technique states
/// why a single pixel may differ ("hard case 13, fast: reason").
Measured distance(const Probe& probe, const Frame& a, const Frame& b) {
  const Difference d = difference(a, b);
  return {probe.opt_out("fast").empty() ? d.max : d.mean, d.place};
}

std::string distance_name(const Probe& probe) {
  return probe.opt_out("fast").empty() ? "largest difference" : "mean difference";
}

void lane_widths(Probe& probe) {
  const Settings few = few_samples(probe.technique());
  const int own = usual_lanes(probe.device()).back();
  for (const Shot& shot : odd_shots()) {
    for (const bool with_normals : {true, false}) {
      Frame frame = shoot(shot, room(), with_normals);
      Lazy<Frame> precise([&] { return probe.outputs(frame, few, {.math = Math::precise, .lanes = 1}); });
      Lazy<Frame> fast([&] { return probe.outputs(frame, few, {.math = Math::fast, .lanes = 1}); });
      for (const int lanes : probe.is_quick() && own > 1 ? std::vector{own} : std::vector{4, 8, 16}) {
        if (!probe.tries(
                fmt::format("{}, lanes {} against 1, {}", text_of(shot.camera), lanes, normals_text(with_normals))))
          continue;
        probe.measure_bits("precise: difference to one lane",
                           probe.outputs(frame, few, {.math = Math::precise, .lanes = lanes}), precise.get());
        const bool is_judged = with_normals || probe.opt_out("fast normals from depth").empty();
        const Frame out = probe.outputs(frame, few, {.math = Math::fast, .lanes = lanes});
        probe.measure(
            fmt::format("{} {} to one lane", is_judged ? "fast:" : "fast, normals from depth:", distance_name(probe)),
            distance(probe, out, fast.get()), is_judged ? 1e-5 : INFINITY);
      }
    }
  }
}

/// CPUs compute the same bits. GPUs fuse and reorder in fast mathematics, and now and then a sample moves by a pixel: for GPUs
/// the share of pixels that differ is bounded, and the largest difference is stated.
void other_devices(Probe& probe) {
  const Settings few = few_samples(probe.technique());
  const auto is_cpu = [](const Device& device) { return device.info().type == "cpu"; };
  if (probe.others().empty()) probe.passes_over("no other device to compare with");
  for (Device* other : probe.others()) {
    const std::string name = other->info().name;
    const bool cpus = is_cpu(*other) && is_cpu(probe.device());
    for (const Shot& shot : odd_shots()) {
      for (const bool with_normals : {true, false}) {
        for (const Math math : {Math::precise, Math::fast}) {
          if (probe.is_quick() && (with_normals || shot.camera.orthographic)) continue;
          if (!probe.tries(fmt::format("{} against {}, {}, {}, {}", probe.device().info().name, name,
                                       text_of(shot.camera), normals_text(with_normals),
                                       math == Math::fast ? "fast" : "precise")))
            continue;
          Frame frame = shoot(shot, room(), with_normals);
          const Frame here = probe.outputs(frame, few, {.math = math}),
                      there = probe.outputs(frame, few, {.math = math}, *other);
          const std::string what = math == Math::fast ? "fast: " : "precise: ";
          if (!cpus) {
            probe.measure(what + "share of values that differ by more than 1e-5 from another kind of device",
                          share_over(here, there, 1e-5), 1e-2);
            probe.measure(what + "largest difference to another kind of device", difference(here, there), INFINITY);
          } else if (math == Math::precise) {
            probe.measure_bits("precise: difference to another device", here, there);
          } else {
            probe.measure("fast: " + distance_name(probe) + " to another device", distance(probe, here, there), 1e-5);
          }
        }
      }
    }
  }
}

/// The largest difference is stated, without a bound: a sample on the border of a pixel may be another pixel's in double, and the
/// result then contains another sample. One pixel of 15552 that differs by one of 31 sectors is 2.1e-6 on average.
void float_against_double(Probe& probe) {
  const bool has_double = probe.device().info().has_double;
  if (!has_double) probe.passes_over(probe.device().info().name + " has no double");
  const Settings samples = probe.usual_samples();
  for (const bool with_normals : {true, false}) {
    if (!with_normals && !probe.opt_out("normals from depth").empty()) continue;
    const std::string normals = normals_text(with_normals);
    Frame frame = shoot(fine_shot(), room(), with_normals);
    Lazy<Frame> exact([&] { return probe.outputs(frame, samples, {.math = Math::precise, .real = Real::float64}); });
    Lazy<Frame> precise([&] { return probe.outputs(frame, samples, {.math = Math::precise}); });
    if (has_double && probe.tries("precise against double, " + normals)) {
      const Difference d = difference(precise.get(), exact.get());
      probe.measure("float against double, " + normals + ": mean difference", {d.mean, d.place}, 4e-6);
      probe.measure("float against double, " + normals + ": largest difference", d, INFINITY);
    }
    if (probe.tries("fast against precise and double, " + normals)) {
      const Frame fast = probe.outputs(frame, samples, {.math = Math::fast});
      const Difference to_precise = difference(fast, precise.get());
      if (has_double) {
        const Difference to_double = difference(fast, exact.get());
        probe.measure("fast float against double, " + normals + ": mean difference", {to_double.mean, to_double.place},
                      4e-6);
      }
      probe.measure("fast against precise, " + normals + ": mean difference", {to_precise.mean, to_precise.place},
                    4e-6);
      probe.measure("fast against precise, " + normals + ": largest difference", to_precise, INFINITY);
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> repeats() {
  return {{13,
           "again, on other lanes and other devices",
           "One seed gives one image. Precise mathematics gives the same bits on every lane width and every CPU; fast "
           "mathematics agrees within 1e-5; on another kind of device at most one value in a hundred differs by more.",
           {one_seed_one_image, lane_widths, other_devices}},
          {14,
           "float against double, fast against precise",
           "The differences of float to double, and of fast to precise mathematics, are stated; on average they are at "
           "most 4e-6.",
           {float_against_double}}};
}

}  // namespace case_files
}  // namespace gloam::stress
