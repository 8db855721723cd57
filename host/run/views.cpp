#include "run/views.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>

#include "base/lists.h"
#include "gloam/error.h"
#include "plan/key_views.h"
#include "plan/layouts.h"
#include "plan/resample.h"
#include "run/arguments.h"
#include "run/checks.h"
#include "run/kernel_projection.h"
#include "run/kernels.h"
#include "run/launch.h"

namespace gloam {
namespace {

bool is_meant_for(const Pass& pass, size_t number, bool is_key_view) {
  switch (pass.on) {
    case On::first_view:
      return number == 0;
    case On::second_view:
      return number == 1;
    case On::key_views:
      return is_key_view;
    case On::views_between:
      return !is_key_view;
    default:
      return true;
  }
}

bool is_of_other_view(const Binding& binding) {
  return binding.from != From::this_view && binding.from != From::frame_before;
}

/// Whether a pass runs on a view: its `On` includes the view, and the planes that it reads are there.
bool runs_on(const PlannedPass& planned, const ViewOnDevice& target, size_t number) {
  if (!is_meant_for(planned.pass, number, target.is_key_view)) return false;
  return std::all_of(planned.pass.reads.begin(), planned.pass.reads.end(),
                     [&](const Binding& b) { return is_of_other_view(b) || target.planes.count(b.plane) > 0; });
}

void add_kernel(const Plan& plan, size_t k, ViewOnDevice& target, const OtherViews& others, Device::Impl& device,
                const RunOptions& options, const Tuning& tuning) {
  const PlannedPass& planned = plan.passes[k];
  target.kernels.push_back(build_kernel(planned, target.layouts, device, options, tuning));
  set_arguments(target.kernels.back(), plan, planned, device, target, others, options);
  target.passes.push_back(k);
  target.times.push_back({target.view.name, planned.label(), {}, {}});
  for (const Binding& written : planned.pass.writes) target.planes.insert(written.plane);
}

/// Runs every pass on all views before the next pass, which may read results of the other view.
template <typename Function>
void for_each_launch(const Plan& plan, std::vector<ViewOnDevice>& targets, const Function& function) {
  std::vector<size_t> next(targets.size(), 0);
  for (size_t k = 0; k < plan.passes.size(); ++k) {
    for (size_t i = 0; i < targets.size(); ++i) {
      ViewOnDevice& target = targets[i];
      if (next[i] < target.passes.size() && target.passes[next[i]] == k) function(target, next[i]++);
    }
  }
}

/// Number of pixels in rows of lanes with at least one bit set.
double pixels_in_rows(ViewOnDevice& target, const std::string& bits_name, int lanes) {
  const uint32_t row_of_lanes = uint32_t((1ull << lanes) - 1);
  const Layout layout = target.layouts.of(bits_name);
  const Channel bits = target.buffers.download_bits(bits_name, layout);
  double pixels = 0;
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; x += lanes) {
      const uint32_t word = std::bit_cast<uint32_t>(bits.at(x / 32, y));
      if ((word >> (x % 32) & row_of_lanes) != 0) pixels += std::min(lanes, layout.width - x);
    }
  }
  return pixels;
}

/// `in_full`: the estimate skips nothing, since others reuse the view.
void count(const Plan& plan, ViewOnDevice& target, int lanes, bool in_full, Counted& counted) {
  const Layout layout = target.layouts.of(plan.wanted);
  const double all = double(layout.width) * layout.height;
  counted.of += all;
  if (!plan.wanted.empty() && !in_full) counted.skipped += all - pixels_in_rows(target, plan.wanted, lanes);
  if (!plan.rest.empty()) counted.rest += pixels_in_rows(target, plan.rest, lanes);
}

void count_listed(const Plan& plan, ViewOnDevice& target, std::map<std::string, long long>& listed) {
  for (const std::string& list : lists_of(plan)) {
    if (target.planes.contains(list)) listed[list] += target.buffers.length_of_list(list);
  }
}

/// Calls a function; an error of OpenCL's names pass `k` of a target.
template <typename Function>
void told(const Plan& plan, const ViewOnDevice& target, size_t k, const Device::Impl& device,
          const Function& function) {
  try {
    function();
  } catch (const cl::Error& error) {
    throw Error("{} on {}: {} ({})", plan.passes[target.passes[k]].label(), device.info.name, error.what(),
                cl_error_name(error.err()));
  }
}

/// Enqueues pass `k` of a target.
Launch enqueue_pass(const Plan& plan, ViewOnDevice& target, size_t k, Device::Impl& device, const Tuning& tuning) {
  const Pass& pass = plan.passes[target.passes[k]].pass;
  constexpr cl_int nothing = 0;
  for (const Binding& written : pass.writes) {
    if (written.starts_empty)
      device.queue.enqueueFillBuffer(target.buffers.of(written.plane).front(), nothing, 0, sizeof nothing);
  }
  return launch(device, target.kernels[k], pass, reduced(target.layout, pass.scale), tuning);
}

/// The launches of all passes of a plan, `repeat` times. Where the device tells their times afterwards, those of one repetition are waited
/// for together, so that the device never waits for the host.
class Launches {
 public:
  Launches(const Plan& plan, Device::Impl& device, const RunOptions& options, const Tuning& tuning, int count)
      : plan_(plan),
        device_(device),
        options_(options),
        tuning_(tuning),
        all_(count * (options.repeat + warm_ups())),
        ahead_(launches_ahead(device.info)) {}

  /// Calls `launch_all`, which calls `launch` for each pass of each target, for each repetition.
  template <typename Function>
  void repeat(const Function& launch_all) {
    for (int i = -warm_ups(); i < options_.repeat; ++i) {
      counts_ = i >= 0;
      launch_all();
      finish_all();
    }
  }

  /// Pass `k` of a target.
  void launch(ViewOnDevice& target, size_t k) {
    told(plan_, target, k, device_, [&] {
      under_way_.push_back({&target, k, enqueue_pass(plan_, target, k, device_, tuning_)});
    });
    if (!ahead_) finish_all();
  }

 private:
  struct UnderWay {
    ViewOnDevice* target;
    size_t k;
    Launch launch;
  };

  int warm_ups() const { return options_.repeat > 1 ? 1 : 0; }

  void finish_all() {
    for (const UnderWay& each : under_way_) {
      told(plan_, *each.target, each.k, device_, [&] {
        const Launched launched = finish(device_, each.launch);
        if (!counts_) return;
        PassTime& times = each.target->times[each.k];
        times.ms.push_back(launched.ms);
        if (device_.info.type == "cpu" && !ahead_) times.cpu_ms.push_back(launched.cpu_ms);
      });
      if (options_.progress) options_.progress(++done_, all_);
    }
    under_way_.clear();
  }

  const Plan& plan_;
  Device::Impl& device_;
  const RunOptions& options_;
  const Tuning tuning_;
  const int all_;
  const bool ahead_;
  bool counts_ = false;
  int done_ = 0;
  std::vector<UnderWay> under_way_;
};

/// Adds a view's planes and times to the result.
void collect(const Plan& plan, ViewOnDevice& target, RunResult& result) {
  View out = without_planes(target.view);
  out.origin = position_origin(target.view, !contains(plan.inputs, "position"));
  count_listed(plan, target, result.listed);
  download(plan, target, out);
  // A view that is only read by others has no result of its own.
  if (!out.planes.empty()) result.frame.views.push_back(std::move(out));
  for (PassTime& time : target.times) result.passes.push_back(std::move(time));
}

/// Runs views that are on the device together.
void run_views(const Plan& plan, const Frame& frame, const std::vector<const View*>& views, Device::Impl& device,
               const RunOptions& options, const Tuning& tuning, RunResult& result, Counted& counted) {
  std::vector<ViewOnDevice> targets;
  for (const View* view : views) targets.push_back(view_on_device(plan, frame, *view, device, options.uploads.get()));
  build_passes(plan, targets, device, options);
  size_t count_of_kernels = 0;
  for (const ViewOnDevice& target : targets) count_of_kernels += target.kernels.size();
  Launches launches(plan, device, options, tuning, int(count_of_kernels));
  launches.repeat(
      [&] { for_each_launch(plan, targets, [&](ViewOnDevice& target, size_t k) { launches.launch(target, k); }); });
  for (ViewOnDevice& target : targets) {
    count(plan, target, tuning.lanes, false, counted);
    collect(plan, target, result);
  }
}

/// Runs a frame's views one after another, with key views that others reuse. Only those key views are on the device that views
/// from the present one on may read.
class KeyViewsRun {
 public:
  KeyViewsRun(const Plan& plan, const Frame& frame, int spacing, Device::Impl& device, const RunOptions& options,
              const Tuning& tuning, Counted& counted)
      : plan_(plan),
        frame_(frame),
        device_(device),
        options_(options),
        tuning_(tuning),
        counted_(counted),
        roles_(key_view_roles(int(frame.views.size()), spacing)),
        launches_(plan, device, options, tuning, count_of_kernels()),
        results_(frame.views.size()) {}

  void run(RunResult& result) {
    for (size_t i = 0; i < roles_.size(); ++i) {
      const KeyViewRole& role = roles_[i];
      if (role.is_key)
        key(i);
      else
        between(i, key(size_t(role.nearest)), key(size_t(role.far)));
      // Views come in order: no later view reads key views before these.
      release_before(role.is_key ? i : size_t(std::min(role.nearest, role.far)));
    }
    release_before(roles_.size());
    for (RunResult& own : results_) {
      std::move(own.frame.views.begin(), own.frame.views.end(), std::back_inserter(result.frame.views));
      std::move(own.passes.begin(), own.passes.end(), std::back_inserter(result.passes));
      for (const auto& [list, length] : own.listed) result.listed[list] += length;
    }
  }

 private:
  ViewOnDevice& key(size_t i) {
    const auto known = keys_.find(i);
    if (known != keys_.end()) return known->second;
    ViewOnDevice& target =
        keys_.emplace(i, view_on_device(plan_, frame_, frame_.views[i], device_, options_.uploads.get())).first->second;
    compute(target, {});
    return target;
  }

  void between(size_t i, ViewOnDevice& nearest, ViewOnDevice& far) {
    const auto steps_to = [i](int key) { return std::abs(double(i) - double(key)); };
    const double to_nearest = steps_to(roles_[i].nearest), to_far = steps_to(roles_[i].far);
    ViewOnDevice target = view_on_device(plan_, frame_, frame_.views[i], device_, options_.uploads.get());
    target.is_key_view = false;
    const double share_of_far = &nearest == &far ? 0 : to_nearest / (to_nearest + to_far);
    compute(target, {.nearest = &nearest, .far = &far, .share_of_far = share_of_far});
    collect(plan_, target, results_[i]);
  }

  void compute(ViewOnDevice& target, const OtherViews& others) {
    for (size_t k = 0; k < plan_.passes.size(); ++k) {
      if (runs_on(plan_.passes[k], target, 0)) add_kernel(plan_, k, target, others, device_, options_, tuning_);
    }
    launches_.repeat([&] {
      for (size_t k = 0; k < target.kernels.size(); ++k) launches_.launch(target, k);
    });
    count(plan_, target, tuning_.lanes, target.is_key_view, counted_);
  }

  int count_of_kernels() const {
    int kernels = 0;
    for (const KeyViewRole& role : roles_) {
      for (const PlannedPass& planned : plan_.passes) kernels += is_meant_for(planned.pass, 0, role.is_key);
    }
    return kernels;
  }

  void release_before(size_t end) {
    while (!keys_.empty() && keys_.begin()->first < end) {
      collect(plan_, keys_.begin()->second, results_[keys_.begin()->first]);
      keys_.erase(keys_.begin());
    }
  }

  const Plan& plan_;
  const Frame& frame_;
  Device::Impl& device_;
  const RunOptions& options_;
  const Tuning tuning_;
  Counted& counted_;
  std::vector<KeyViewRole> roles_;
  Launches launches_;
  std::vector<RunResult> results_;       // view by view
  std::map<size_t, ViewOnDevice> keys_;  // key views on the device
};

}  // namespace

void build_passes(const Plan& plan, std::vector<ViewOnDevice>& targets, Device::Impl& device,
                  const RunOptions& options) {
  const Tuning tuning = tuning_for(device.info, options);
  for (size_t k = 0; k < plan.passes.size(); ++k) {
    for (size_t i = 0; i < targets.size(); ++i) {
      const OtherViews others{.other = targets.size() == 2 ? &targets[1 - i] : nullptr};
      if (runs_on(plan.passes[k], targets[i], i)) add_kernel(plan, k, targets[i], others, device, options, tuning);
    }
  }
}

void enqueue_passes(const Plan& plan, std::vector<ViewOnDevice>& targets, Device::Impl& device,
                    const RunOptions& options) {
  const Tuning tuning = tuning_for(device.info, options);
  for_each_launch(plan, targets, [&](ViewOnDevice& target, size_t k) {
    told(plan, target, k, device, [&] { enqueue_pass(plan, target, k, device, tuning); });
  });
}

void run_all_views(const Plan& plan, const Frame& frame, Device::Impl& device, const RunOptions& options,
                   RunResult& result, Counted& counted) {
  if (const int spacing = key_view_spacing(plan, frame.views.size()); spacing > 1) {
    KeyViewsRun(plan, frame, spacing, device, options, tuning_for(device.info, options), counted).run(result);
    return;
  }
  std::vector<std::vector<const View*>> groups(needs_two_views(plan) ? 1 : frame.views.size());
  for (size_t i = 0; i < frame.views.size(); ++i) groups[std::min(i, groups.size() - 1)].push_back(&frame.views[i]);
  for (const std::vector<const View*>& views : groups)
    run_views(plan, frame, views, device, options, tuning_for(device.info, options), result, counted);
}

}  // namespace gloam
