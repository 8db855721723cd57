// Runs a plan on a device: every pass is timed, checked and named here.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"

namespace gloam {

/// Planes of a frame on their way to a device's memory (`upload`).
struct Uploads;

enum class Math { precise, fast };
enum class Real { float32, float64 };

struct RunOptions {
  Math math = Math::fast;
  Real real = Real::float32;
  int lanes = 0;  ///< pixels per work-item: 1, 4, 8, 16; 0: what suits the device (half as many for double)
  int group = 0;  ///< most work-items per work-group, 1 to 1024; 0: what suits the device
  int seed = 0;
  int repeat = 1;  ///< timed runs; more than one: after an untimed warm-up
  /// Adds up the values that samples read instead of what they contribute, to measure the cost of addresses and reads alone. The
  /// result has no meaning.
  bool gathers_only = false;
  std::function<void(int done, int of)> progress = {};  ///< called after each launch of a pass
  std::shared_ptr<Uploads> uploads = {};  ///< of this frame, by this device; what is not among them is uploaded
};

struct PassTime {
  std::string view, name;      ///< "hbao+/estimate"
  std::vector<double> ms;      ///< one per repeat, by OpenCL events; by wall clock if a device's events read 0
  std::vector<double> cpu_ms;  ///< on a CPU: what the process's threads computed, together; else empty
};

struct RunResult {
  Frame frame;                       ///< the plan's outputs, with the input's windows, views and cameras
  std::vector<PassTime> passes;      ///< per view, in order
  std::vector<double> total_ms;      ///< one per repeat: the sum over passes
  std::vector<double> total_cpu_ms;  ///< the same of `PassTime::cpu_ms`; empty where that is
  int lanes = 1;
  /// Share of all views' pixels that the estimate skipped: rows of lanes without a wanted pixel.
  double skipped_share = 0;
  /// Share of all views' pixels that a plan's second estimate computed (`Plan::rest`).
  double rest_share = 0;
  /// Pixels of all views that passes put on a list, to be computed one by one (shared/lanes/pixel_list.h), by the list's plane.
  std::map<std::string, long long> listed;
  unsigned long long device_bytes = 0;  ///< of the views that are in memory at the same time
};

/// Device memory of a plan, bytes, for a frame of `views` views: one view at a time, or all at once if views read one another.
unsigned long long device_bytes(const Plan& plan, const Layout& layout, size_t views = 1);

/// Host memory that a run needs besides the frame, bytes: its results, and on a device that shares the host's memory, all planes
/// that it computes.
unsigned long long bytes_beside_frame(const Plan& plan, const Layout& layout, size_t views, bool shares_memory);

/// Throws as `run` would if a device cannot run a plan on so many views: for lack of memory or of double precision.
void check(const Plan& plan, const Layout& layout, size_t views, const Device& device, const RunOptions& options = {});

/// Compiles a plan's kernels before `run`, for example while a frame is being decoded. Throws as `run` would.
void prepare(const Plan& plan, Device& device, const RunOptions& options = {});

/// Sends a frame's planes to a device that has memory of its own, while the device computes another frame, from any thread: for
/// `RunOptions::uploads`. Null where that does not help or two frames are on their way: then `run` sends them. The frame has to stay where
/// and as it is, and the device to live, until what is returned is gone.
std::shared_ptr<Uploads> upload(const Plan& plan, const Frame& frame, Device& device);

/// Runs a plan on every view of a frame that has passed `normalise` (normalise.h). Runs on one device go one after another,
/// whichever threads they come from; `RunOptions::progress` may itself use the device.
/// Throws UsageError for options out of range. Throws Error for a frame without pixels, for a camera that `check` (camera.h)
/// refuses, for an input plane that a view lacks or has in another size, if device memory does not suffice (naming needed and
/// available), for double on a device without it, for build errors (with the kernel's log), and for kernel arguments that do not
/// match the declaration (naming both sides).
RunResult run(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options = {});

}  // namespace gloam
