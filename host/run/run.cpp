#include "gloam/run.h"

#include <algorithm>

#include "gloam/error.h"
#include "plan/layouts.h"
#include "plan/lifetimes.h"
#include "run/checks.h"
#include "run/driver.h"
#include "run/kernels.h"
#include "run/views.h"

namespace gloam {

namespace {

/// At its end nothing that was enqueued reads the frame any more, also after an error.
struct AllEnded {
  cl::CommandQueue& queue;
  ~AllEnded() {
    try {
      queue.finish();
    } catch (const cl::Error&) {  // the error under way says it
    }
  }
};

}  // namespace

unsigned long long device_bytes(const Plan& plan, const Layout& layout, size_t views) {
  return views_at_once(plan, views) * bytes_of_planes(plan, Layouts(plan, layout));
}

unsigned long long bytes_beside_frame(const Plan& plan, const Layout& layout, size_t views, bool shares_memory) {
  const Layouts layouts(plan, layout);
  const unsigned long long buffers = bytes_of_planes(plan, layouts, true);
  unsigned long long results = 0;
  for (const std::string& name : plan.outputs) results += bytes_of(plan, layouts, name);
  const size_t at_once = std::min(views_at_once(plan, views), views);
  // Results of the earlier views; those of the last views are still buffers.
  return shares_memory ? at_once * buffers + (views - at_once) * results : views * results;
}

void check(const Plan& plan, const Layout& layout, size_t views, const Device& device, const RunOptions& options) {
  check_options(plan, device.info(), options);
  check_memory(plan, layout, views, device.info());
}

void prepare(const Plan& plan, Device& device, const RunOptions& options) {
  Device::Impl& impl = device.impl();
  const std::lock_guard alone(impl.busy);
  const DriverAtWork driver;
  const Layouts layouts(plan, Layout(1, 1));
  for (const PlannedPass& planned : plan.passes)
    build_kernel(planned, layouts, impl, options, tuning_for(impl.info, options));
}

RunResult run(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options) {
  Device::Impl& impl = device.impl();
  const std::lock_guard alone(impl.busy);
  check_views(plan, frame);
  const Layout layout(frame.width(), frame.height());
  check(plan, layout, frame.views.size(), device, options);
  RunResult result;
  result.lanes = tuning_for(impl.info, options).lanes;
  result.device_bytes = device_bytes(plan, layout, frame.views.size());
  result.frame.display = frame.display;
  result.frame.window = frame.window;
  result.frame.pixel_aspect = frame.pixel_aspect;
  result.frame.assumed = frame.assumed;
  Counted counted;
  const DriverAtWork driver;
  impl.pool.begin_run(result.device_bytes, impl.info.memory);
  const AllEnded all_ended{impl.queue};
  try {
    run_all_views(plan, frame, impl, options, result, counted);
  } catch (const cl::Error& error) {
    throw Error("{} on {}: {} ({})", plan.technique, impl.info.name, error.what(), cl_error_name(error.err()));
  }
  if (counted.of > 0) {
    result.skipped_share = counted.skipped / counted.of;
    result.rest_share = counted.rest / counted.of;
  }
  result.total_ms.assign(size_t(options.repeat), 0.0);
  for (const PassTime& pass : result.passes) {
    for (size_t i = 0; i < pass.ms.size(); ++i) result.total_ms[i] += pass.ms[i];
    result.total_cpu_ms.resize(std::max(result.total_cpu_ms.size(), pass.cpu_ms.size()));
    for (size_t i = 0; i < pass.cpu_ms.size(); ++i) result.total_cpu_ms[i] += pass.cpu_ms[i];
  }
  return result;
}

}  // namespace gloam
