#include "run/checks.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/lists.h"
#include "frame/check.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/layouts.h"

namespace gloam {
namespace {

std::string mebibytes(unsigned long long bytes) { return fmt::format("{} MiB", (bytes + (1 << 20) - 1) >> 20); }

/// Checks the poses of views that read one another.
void check_poses(const Plan& plan, const Frame& frame) {
  for (const View& view : frame.views) {
    if (!view.camera->pose)
      throw Error(
          "{}: view '{}' has a camera without a pose, so its position beside the {} is unknown; give camera_to_world "
          "in a {} file",
          plan.technique, view.name, frame.views.size() > 2 ? "others" : "other", option("camera"));
  }
}

/// The technique that the plan is named after, if it runs.
const Technique* leading_technique(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.technique->name == plan.technique) return planned.technique;
  }
  return nullptr;
}

/// Throws Error for a view of a light-field module, which has no single centre of projection. The message depends on why the
/// technique that needs one runs: the user asked for it, or a plane is missing.
[[noreturn]] void refuse_module(const Plan& plan, const Technique& refusing, const View& view) {
  const std::string what = fmt::format(
      "view '{}' is of a light-field display's module, which has no single centre of projection", view.name);
  const Technique* leading = leading_technique(plan);
  if (!leading || !leading->any_projection) {
    std::vector<std::string> able;
    for (const Technique& technique : registry()) {
      if (technique.any_projection && technique.key_views) able.push_back(technique.name);
    }
    throw Error("{}: {}; {} compute such views", refusing.name, what, enumerate(able));
  }
  for (const std::string& plane : refusing.writes) {
    if (contains(leading->reads, plane))
      throw Error("{}: {}, and {} needs one; give a frame with {}", leading->name, what, refusing.name, plane);
  }
  // Passes that nobody can ask for are the plan's own.
  const bool is_asked_for = contains(technique_names(), refusing.name);
  throw Error(
      "{}: {}, and {} needs one; leave it out", leading->name, what,
      is_asked_for ? refusing.name : fmt::format("what {} or {} adds", option("resolution"), option("adaptive")));
}

/// Checks that a view has what the plan's passes need to know about its projection.
void check_projections(const Plan& plan, const Frame& frame) {
  const bool reads_positions = contains(plan.inputs, "position");
  for (const View& view : frame.views) {
    if (reads_positions && !view.camera->pose)
      throw Error("{}: positions of view '{}' are in world space, and its camera has no pose; {} makes them from depth",
                  plan.technique, view.name, channels_option("position", "none"));
    if (!view.camera->slits) continue;
    for (const PlannedPass& planned : plan.passes) {
      if (!planned.technique->any_projection) refuse_module(plan, *planned.technique, view);
    }
  }
}

}  // namespace

void check_memory(const Plan& plan, const Layout& layout, size_t views, const DeviceInfo& info) {
  const unsigned long long needed = device_bytes(plan, layout, views);
  if (needed > info.memory) {
    throw Error("{}: {}x{} pixels need {} of device memory, and {} has {}; use a smaller frame or another {}",
                plan.technique, layout.width, layout.height, mebibytes(needed), info.name, mebibytes(info.memory),
                option("device"));
  }
  if (layout.count() > size_t(std::numeric_limits<int>::max())) {
    throw Error("{}: {}x{} pixels with rows padded to {} are more than 2^31; use a smaller frame", plan.technique,
                layout.width, layout.height, layout.pitch);
  }
  const Layouts layouts(plan, layout);
  for (const std::string& name : planes_of(plan)) {
    const size_t layers = layers_in_buffer(plan, name);
    const unsigned long long bytes = bytes_of_buffer(plan, layouts, name);
    // Kernels that divide a stack by themselves count its floats in an int.
    if (more_rows_in_buffer(plan, name) > 0 && bytes / sizeof(float) > size_t(std::numeric_limits<int>::max()))
      throw Error("{}: {}x{} pixels are more than 2^31 values in '{}'; use a smaller frame", plan.technique,
                  layout.width, layout.height, name);
    if (bytes <= info.largest_buffer) continue;
    const std::string what = layers == 1 ? "one plane" : fmt::format("'{}', {} layers", name, layers);
    throw Error("{}: {} of {}x{} pixels takes {}, and {} allows {} for one buffer; use a smaller frame or another {}",
                plan.technique, what, layout.width, layout.height, mebibytes(bytes), info.name,
                mebibytes(info.largest_buffer), option("device"));
  }
}

void check_options(const Plan& plan, const DeviceInfo& info, const RunOptions& options) {
  if (options.lanes != 0 && !std::count(lane_widths.begin(), lane_widths.end(), options.lanes))
    throw UsageError("{}: {} lanes are not allowed; 1, 4, 8 and 16 are, and 0 for what suits the device",
                     plan.technique, options.lanes);
  if (options.group < 0 || options.group > most_per_group)
    throw UsageError("{}: work-groups of {} are not allowed; 1 to {} work-items are, and 0 for what suits the device",
                     plan.technique, options.group, most_per_group);
  if (options.repeat < 1)
    throw UsageError("{}: {} runs are not allowed; 1 and more are", plan.technique, options.repeat);
  if (options.real == Real::float64 && !info.has_double) {
    throw Error("{}: {} has no double precision; use {} or another {}", plan.technique, info.name,
                option("real", "float"), option("device"));
  }
}

void check_number_of_views(const Plan& plan, size_t views) {
  if (needs_two_views(plan) && views != 2)
    throw Error(
        "{}: needs a frame of two views, and this one has {}; gloam capture --view2 ANGLE or --stereo IPD makes one, "
        "{} takes two of more",
        plan.technique, views, option("views", "A,B"));
}

void check_views(const Plan& plan, const Frame& frame) {
  check_window(frame);
  for (const View& view : frame.views) {
    if (!view.camera) throw Error("{}: view '{}' has no camera", plan.technique, view.name);
    check(*view.camera);
  }
  check_projections(plan, frame);
  check_number_of_views(plan, frame.views.size());
  if (needs_two_views(plan) || key_view_spacing(plan, frame.views.size()) > 1) check_poses(plan, frame);
}

}  // namespace gloam
