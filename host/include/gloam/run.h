// The only place that enqueues: every pass is timed, checked and named here.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"

namespace gloam {

enum class Math { precise, fast };
enum class Real { float32, float64 };

struct RunOptions {
  Math math = Math::fast;
  Real real = Real::float32;
  int lanes = 0;  ///< pixels per work-item: 1, 4, 8, 16; 0: what suits the device (half of it for double)
  int seed = 0;
  int repeat = 1;  ///< timed runs; more than one: after an untimed warm-up
  /// Instead of what samples contribute, adds up what is read: what a kernel's addresses and reads cost by themselves. The
  /// result means nothing.
  bool gathers_only = false;
  std::function<void(int done, int of)> progress = {};  ///< called after each launch of a pass
};

struct PassTime {
  std::string view, name;  ///< "hbao+/estimate"
  std::vector<double> ms;  ///< one per repeat, by OpenCL events; wall clock where a device's events read 0
};

struct RunResult {
  Frame frame;                   ///< the plan's outputs, with the input's windows, views and cameras
  std::vector<PassTime> passes;  ///< per view, in order
  std::vector<double> total_ms;  ///< one per repeat: the sum over passes
  int lanes = 1;
  /// Share of all views' pixels that the estimate skipped: those of rows of lanes of which the mask wants none.
  double skipped_share = 0;
  /// Share of them that a plan's second estimate saw to (`Plan::rest`), in such rows.
  double rest_share = 0;
  /// Pixels of all views that passes put on a list, for others to compute one by one (shared/lanes/pixel_list.h): by the list's plane.
  std::map<std::string, long long> listed;
  unsigned long long device_bytes = 0;  ///< of the views that are there at the same time
};

/// Bytes of device memory that a plan takes for a frame of so many views: of one of them, or of those that look into one another.
unsigned long long device_bytes(const Plan& plan, const Layout& layout, size_t views = 1);

/// Bytes of the host's memory that a run takes beside the frame: results, and where the device shares the memory of the host all
/// that is computed.
unsigned long long bytes_beside_frame(const Plan& plan, const Layout& layout, size_t views, bool shares_memory);

/// Whether a device can run a plan on so many views: its memory, double precision. Throws what `run` would.
void check(const Plan& plan, const Layout& layout, size_t views, const Device& device, const RunOptions& options = {});

/// Compiles a plan's kernels ahead of `run`, so that this goes on while a frame is decoded. Throws what `run` would.
void prepare(const Plan& plan, Device& device, const RunOptions& options = {});

/// Runs a plan on every view of a frame that has passed `normalise` (normalise.h). Runs on one device go one after another, whichever
/// threads they come from; `RunOptions::progress` may itself use the device.
/// Throws UsageError for options that are not allowed; Error for a frame without pixels, a camera that `check` (camera.h) refuses, a
/// plane of the plan's inputs that a view lacks or has in another size; out of device memory (needed and available), double where the device has none, build errors with the
/// kernel's log, kernel arguments that do not match the declaration (naming both sides).
RunResult run(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options = {});

}  // namespace gloam
