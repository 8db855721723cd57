// Runs every technique once on small frames, one pixel per work-item, under oclgrind, which finds accesses out of bounds. The
// long run covers all choices, switches and counts; every run covers the defaults with few samples. With precise mathematics it
// prints the bits, which must be those of other devices.
#include <cstdio>
#include <cstdlib>

#include "gloam/error.h"
#include "scene/fingerprint.h"
#include "support/kernel_runs.h"
#include "support/long.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

// Wide and low: a row has more floats than the guard, so that one row too far lies outside the buffer; and few pixels, since
// oclgrind interprets every sample, of which a pixel has hundreds.
constexpr int width = 65, height = 3;
static_assert(width > Layout::guard);

std::string bits_of(const Frame& frame) {
  Fingerprint fingerprint;
  for (const View& view : frame.views) {
    for (const auto& [name, plane] : view.planes) {
      for (const Channel& channel : plane.channels) {
        for (int y = 0; y < frame.height(); ++y)
          fingerprint.add_bytes(channel.row(y), size_t(frame.width()) * sizeof(float));
      }
    }
  }
  return fingerprint.text();
}

/// Prints the bits for as few pixels as show everything near each other: in a lower image nearly all samples would lie outside.
int tell_bits(const Technique& technique) {
  Frame frame = shoot(perspective(20, 15), room());
  const Plan plan = plan_for(technique, frame, few_samples(technique));
  const Frame out = std::move(run(plan, frame, device(), {.math = Math::precise, .lanes = 1}).frame);
  std::printf("bits of %s: %s\n", technique.name.c_str(), bits_of(out).c_str());
  return int(plan.passes.size());
}

int run_each(const std::vector<KernelRun>& runs) {
  int passes = 0;
  for (const KernelRun& each : runs) {
    run(each.plan, each.frame, device(), {.math = each.math, .lanes = 1});
    passes += int(each.plan.passes.size());
  }
  return passes;
}

/// Every `parts`-th technique, from `part` on; `bits_only`: only the printing of bits.
int run_all(size_t part, size_t parts, bool bits_only) {
  const Coverage coverage{.width = width, .height = height, .every_setting = is_long_run()};
  int passes = part == 0 && !bits_only ? run_each(runs_of_plans(coverage)) : 0;
  for (size_t i = part; i < registry().size(); i += parts) {
    passes += tell_bits(registry()[i]);
    if (!bits_only) passes += run_each(runs_of(registry()[i], coverage));
  }
  std::printf("ran %d passes on %s\n", passes, device().info().platform.c_str());
  return passes > 0 ? 0 : 1;
}

}  // namespace
}  // namespace gloam::test

/// Arguments: the part of the techniques, the number of parts, and "bits" to print only the bits.
int main(int argc, char** argv) {
  const bool bits_only = argc == 4 && std::string(argv[3]) == "bits";
  if (argc != 3 && !bits_only) return 2;
  try {
    return gloam::test::run_all(size_t(std::atoi(argv[1])), size_t(std::atoi(argv[2])), bits_only);
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
