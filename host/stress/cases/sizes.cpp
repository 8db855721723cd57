// Hard case 11: images of every shape. Memory beside an image must not affect it.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "base/file_lock.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

/// Fills everything beside the image with a value that would show.
void spoil_padding(Frame& frame, float value) {
  for (View& view : frame.views) {
    for (auto& [name, plane] : view.planes) {
      for (Channel& channel : plane.channels) channel.fill_padding(value);
    }
  }
}

struct Size {
  int width, height;
};

std::vector<Size> sizes(bool is_quick) {
  if (is_quick) return {{1, 1}, {1, 33}, {33, 1}, {17, 13}, {16384, 1}};
  return {{1, 1}, {1, 33}, {33, 1}, {2, 2}, {15, 3}, {16, 3}, {17, 13}, {16384, 1}, {1, 16384}, {32769, 3}};
}

void sizes_and_padding(Probe& probe) {
  const Settings few = few_samples(probe.technique());
  for (const auto& [width, height] : sizes(probe.is_quick())) {
    const double fov = width > 1000 ? 150 : 60;
    for (const Shot& shot : {perspective(width, height, fov), orthographic(width, height, width * 0.05)}) {
      // PoCL recompiles a kernel for each size of its groups: in a quick run one camera per size is enough.
      if (probe.is_quick() && shot.camera.orthographic != (width == 1)) continue;
      Frame frame = shoot(shot, room());
      plan_for(probe.technique(), frame);  // adds the second view, whose padding is spoilt too
      Lazy<Frame> expected([&] { return probe.outputs(frame, few, {.math = Math::precise, .lanes = 1}); });
      for (const int lanes : usual_lanes(probe.device())) {
        for (const float beside : {0.37f, 5.0f}) {
          const RunOptions way{.math = Math::precise, .lanes = lanes};
          if (!probe.tries(fmt::format("{}x{}, {} beside the image, {}, {}", width, height, beside,
                                       text_of(shot.camera), text_of(way))))
            continue;
          Frame spoilt = clone(frame);
          spoil_padding(spoilt, beside);
          const Frame out = probe.outputs(spoilt, few, way);
          probe.measure_violation("value out of its range", out);
          probe.measure("size: columns and rows too few or too many",
                        double(std::abs(out.width() - width) + std::abs(out.height() - height)), 0);
          probe.measure_bits("difference by what lies beside the image, or by lanes", out, expected.get());
        }
      }
    }
  }
}

// --- 8192x8192

/// Kilobytes after a key in a file of /proc; -1 if there is no such key.
long kilobytes(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key + ":")) return std::stol(line.substr(key.size() + 1));
  }
  return -1;
}

long peak_kilobytes() { return kilobytes("/proc/self/status", "VmHWM"); }
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

constexpr int large = 8192, tile = 256;

/// A wall with square blocks before it, the same in every tile: one tile can be compared with all others.
Frame blocks() {
  Frame frame = blank(orthographic(large, large, large / 64.0));
  for (const char* name : {"depth", "normal"}) plane_of(frame, name);
  Plane& normal = plane_of(frame, "normal");
  Channel& depth = plane_of(frame, "depth").channels[0];
  for (int y = 0; y < large; ++y) {
    std::fill_n(normal.channels[2].row(y), large, 1.0f);
    for (int x = 0; x < large; ++x) depth.row(y)[x] = (x % tile < tile / 2) == (y % tile < tile / 2) ? 2.0f : 2.2f;
  }
  return frame;
}

/// Largest difference of a pixel to the one at the same position in the first tile that the border does not reach.
Measured difference_of_tiles(const std::string& name, const Channel& values) {
  Measured worst(0.0);
  for (int y = tile; y < large - tile; ++y) {
    for (int x = tile; x < large - tile; ++x) {
      const double here = values.at(x, y), first = values.at(tile + x % tile, tile + y % tile);
      if (std::abs(here - first) > worst.value)
        worst = {std::abs(here - first), Place{"", name, x, y, fmt::format("{} against {}", here, first)}};
    }
  }
  return worst;
}

/// Only one process at a time computes so large an image: the next one then sees how much memory is left.
class LargeImageAlone {
 public:
  LargeImageAlone() {
    constexpr double patience = 1e9;  ///< seconds; the parent ends a child that takes too long
    const std::string name = fmt::format(".gloam-stress-large-image-{}", getuid());
    try {
      lock_.emplace(std::filesystem::temp_directory_path() / name, FileLock::Ranges{{0, 0}}, patience);
    } catch (const std::exception&) {  // without it, two may take more memory than there is
    }
  }

 private:
  std::optional<FileLock> lock_;
};

/// Relative excess of the memory taken over the prediction; below 0 if less was taken. The compiler's memory is not counted.
double memory_over_prediction(const Probe& probe, const Plan& plan, const Frame& frame, RunResult& result) {
  Frame warm_up = shoot(perspective(64, 64), room());
  plan_for(probe.technique(), warm_up);
  run(plan, warm_up, probe.device());
  forget_peak();
  const long before = peak_kilobytes();
  result = run(plan, frame, probe.device());
  const double grown = double(peak_kilobytes() - before) * 1024;
  double inputs = 0;  // the host's own pages on a CPU; on other devices they exist twice
  for (const std::string& name : plan.inputs)
    inputs += double(plane_kind(name).components.size()) * double(Layout(large, large).bytes());
  return before < 0 ? 0 : (grown + inputs) / double(result.device_bytes) - 1;
}

/// With jitter, equal places get equal values only on average.
Settings without_jitter(const Plan& plan) {
  Settings settings;
  for (const PlannedPass& planned : plan.passes) {
    if (planned.values.has("jitter")) settings.emplace_back(planned.technique->name + ".jitter", "off");
  }
  return settings;
}

void largest_image(Probe& probe) {
  if (probe.is_quick()) return probe.passes_over("8192x8192: not in a quick run");
  Frame small = shoot(perspective(8, 8), room());
  const std::vector<std::string> given = plane_names(small);
  const Settings lengths = set_lengths(probe.technique(), small, [](double) { return 0.5; });
  const Settings few = few_samples(probe.technique()) + lengths;
  const Plan plan = plan_for(probe.technique(), small, few + without_jitter(plan_for(probe.technique(), small, few)));
  if (plane_names(small) != given || probe.technique().views > 1)
    return probe.passes_over("8192x8192: needs more than depth and normals of one view");
  const LargeImageAlone alone;
  const DeviceInfo& device = probe.device().info();
  const double frames =
      2.0 * 5 * double(Layout(large, large).bytes());  // the host's, of depth and normals, and results
  const double needed = double(device_bytes(plan, Layout(large, large))) + frames;
  const long available = kilobytes("/proc/meminfo", "MemAvailable");
  if (needed > double(device.memory) || (available >= 0 && double(available) * 1024 < 1.2 * needed))
    return probe.passes_over(fmt::format("8192x8192: needs {:.1f} GB", needed * 1e-9));
  if (!probe.tries("8192x8192, a pattern of blocks")) return;
  RunResult result;
  const double over = memory_over_prediction(probe, plan, blocks(), result);
  probe.measure("8192x8192: columns and rows too few or too many",
                double(std::abs(result.frame.width() - large) + std::abs(result.frame.height() - large)), 0);
  probe.measure_violation("8192x8192: value out of its range", result.frame);
  for (const std::string& name : unit_interval_outputs(plan))
    probe.measure("8192x8192: difference between like places",
                  difference_of_tiles(name, result.frame.views[0].find(name)->channels[0]), 1e-5);
  if (device.shares_memory) probe.measure("8192x8192: memory against the prediction, as a share", std::abs(over), 0.05);
}

}  // namespace

namespace case_files {

std::vector<Case> sizes() {
  return {{11,
           "images of every shape",
           "Images of 1x1, one row, one column, odd sizes and 16384 pixels in a row have the right size, and the same "
           "bits whatever lies beside them in memory and however many lanes compute them; in an image of 8192x8192 "
           "equal places get equal values, and the memory used is as predicted.",
           {sizes_and_padding, largest_image}}};
}

}  // namespace case_files
}  // namespace gloam::stress
