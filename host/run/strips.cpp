#include "gloam/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/projection.h"
#include "gloam/radius.h"
#include "run/checks.h"

namespace gloam {
namespace {

/// Rows that neighbours of pixels take, such as those that normals are made of.
constexpr int rows_of_neighbours = 8;

/// Why a pass's image depends on more than the rows nearby; empty if it does not.
std::string why_not(const PlannedPass& planned) {
  const Pass& pass = planned.pass;
  if (pass.scale != 1) return fmt::format("{} works on images of a lower resolution", planned.technique->name);
  if (planned.technique->views > 1 || planned.technique->key_views)
    return fmt::format("{} reads the other view", planned.technique->name);
  for (const Binding& read : pass.reads) {
    if (read.from != From::this_view) return fmt::format("{} reads another image", planned.technique->name);
  }
  if (pass.footprint.is_wide && !planned.values.has("max_reach"))
    return fmt::format("{} reads the whole image", planned.technique->name);
  return "";
}

std::string why_not(const Plan& plan, const Frame& frame) {
  for (const PlannedPass& planned : plan.passes) {
    if (const std::string why = why_not(planned); !why.empty()) return why;
  }
  for (const View& view : frame.views) {
    if (view.camera->slits) return "a light-field display's views are computed whole";
  }
  return "";
}

/// Rows that a radius reaches at most in a view. Samples lie within twice the radius on the screen (kernels/shared/sampling/ball.h), and
/// farther out where rays slant.
double rows_of_radius(double radius, double cap, const View& view, const Frame& frame) {
  const Camera& camera = *view.camera;
  const double across =
      std::max(std::abs(frame.window.x0 - camera.cx), std::abs(frame.window.x1 - camera.cx)) / camera.fx;
  const double up = std::max(std::abs(frame.window.y0 - camera.cy), std::abs(frame.window.y1 - camera.cy)) / camera.fy;
  const double slant = camera.orthographic ? 1 : std::sqrt(1 + across * across + up * up);
  const Plane* depth = view.find("depth");
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 0; depth && y < frame.height(); ++y) {
    const float* row = depth->channels.front().row(y);
    for (int x = 0; x < frame.width(); ++x) nearest = std::min(nearest, double(row[x]));
  }
  const double pixels =
      std::isinf(nearest) ? 0 : radius * pixels_per_unit(camera, nearest) * std::max(1.0, camera.fy / camera.fx);
  return 2.02 * slant * std::min(std::isnan(pixels) ? cap : pixels, cap);
}

int margin_of(const Plan& plan, const Frame& frame) {
  double rows = rows_of_neighbours, reach = 0;
  for (const PlannedPass& planned : plan.passes) {
    rows += planned.pass.footprint.rows;
    if (!planned.pass.footprint.is_wide) continue;
    const double cap = planned.values.number("max_reach") * frame.width();
    for (const View& view : frame.views)
      reach = std::max(reach, rows_of_radius(planned.values.number(radius_parameter(planned.technique->parameters)),
                                             cap, view, frame));
  }
  return int(std::min(rows + std::ceil(reach), double(frame.height())));
}

/// Whether a device has the memory for strips of so many rows, margins included.
bool fits(const Plan& plan, const Frame& frame, const DeviceInfo& device, int rows) {
  try {
    check_memory(plan, Layout(frame.width(), std::min(rows, frame.height())), frame.views.size(), device);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void add_to(std::vector<double>& sums, const std::vector<double>& times) {
  for (size_t k = 0; k < sums.size(); ++k) sums[k] += times[k];
}

Frame rows_of(const Plan& plan, const Frame& frame, int first, int last) {
  Frame part = without_planes(frame);
  part.window = {frame.window.x0, frame.window.y0 + first, frame.window.x1, frame.window.y0 + last};
  const Layout layout(frame.width(), last - first);
  for (const View& view : frame.views) {
    View& to = part.view(view.name);
    for (const auto& [name, plane] : view.planes) {
      if (!contains(plan.inputs, name)) continue;
      Plane& copy = to.planes[name];
      copy.name = name;
      for (const Channel& channel : plane.channels) {
        Channel& rows = copy.channels.emplace_back(layout);
        std::copy(channel.row(first), channel.row(first) + size_t(layout.pitch) * size_t(layout.height), rows.row(0));
        rows.fill_padding(plane_kind(name).outside);
      }
    }
  }
  return part;
}

/// Adds the rows of a strip to the whole image, and the strip's times to the whole's.
void add(const RunResult& strip, int from, int first, int last, const Layout& layout, RunResult& whole) {
  for (const View& view : strip.frame.views) {
    View& to = whole.frame.view(view.name);
    for (const auto& [name, plane] : view.planes) {
      Plane& image = to.planes[name];
      image.name = name;
      for (size_t i = 0; i < plane.channels.size(); ++i) {
        if (image.channels.size() == i) image.channels.emplace_back(layout, plane_kind(name).outside);
        const float* rows = plane.channels[i].row(first - from);
        std::copy(rows, rows + size_t(layout.pitch) * size_t(last - first), image.channels[i].row(first));
      }
    }
  }
  if (whole.passes.empty()) {
    whole.passes = strip.passes;
    whole.total_ms = strip.total_ms;
    whole.total_cpu_ms = strip.total_cpu_ms;
    return;
  }
  for (size_t i = 0; i < whole.passes.size(); ++i) {
    add_to(whole.passes[i].ms, strip.passes[i].ms);
    add_to(whole.passes[i].cpu_ms, strip.passes[i].cpu_ms);
  }
  add_to(whole.total_ms, strip.total_ms);
  add_to(whole.total_cpu_ms, strip.total_cpu_ms);
}

}  // namespace

Strips strips_for(const Plan& plan, const Frame& frame, const DeviceInfo& device, int count) {
  Strips strips;
  strips.why_not = why_not(plan, frame);
  if (!strips.why_not.empty()) return strips;
  const int height = frame.height();
  strips.margin = margin_of(plan, frame);
  strips.count = std::clamp(count, 1, height);
  const auto rows = [&] { return (height + strips.count - 1) / strips.count; };
  while (count == 0 && strips.count < height && !fits(plan, frame, device, rows() + 2 * strips.margin))
    strips.count = std::min(2 * strips.count, height);
  strips.rows = rows();
  strips.count = (height + strips.rows - 1) / strips.rows;
  const Layout layout(frame.width(), std::min(strips.rows + 2 * strips.margin, height));
  strips.device_bytes = device_bytes(plan, layout, frame.views.size());
  if (!fits(plan, frame, device, layout.height))
    strips.why_not = fmt::format("the radius and the filters reach {} rows of the {}", strips.margin, height);
  return strips;
}

RunResult run_in_strips(const Plan& plan, const Frame& frame, Device& device, const RunOptions& options,
                        const Strips& strips) {
  if (!strips.why_not.empty()) throw Error("{}: cannot be computed in strips: {}", plan.technique, strips.why_not);
  RunResult whole;
  const Layout layout(frame.width(), frame.height());
  for (int first = 0; first < frame.height(); first += strips.rows) {
    const int last = std::min(first + strips.rows, frame.height());
    const int from = std::max(first - strips.margin, 0), to = std::min(last + strips.margin, frame.height());
    const RunResult strip = run(plan, rows_of(plan, frame, from, to), device, options);
    if (first == 0) {
      whole.frame = without_planes(strip.frame);
      whole.frame.window = frame.window;
    }
    add(strip, from, first, last, layout, whole);
    whole.lanes = strip.lanes;
    whole.device_bytes = std::max(whole.device_bytes, strip.device_bytes);
    whole.skipped_share += strip.skipped_share * (last - first) / frame.height();
    whole.rest_share += strip.rest_share * (last - first) / frame.height();
  }
  return whole;
}

void check_memory_or_offer_strips(const Plan& plan, const Frame& frame, const Device& device, const std::string& way) {
  const Layout layout(frame.width(), frame.height());
  try {
    check_memory(plan, layout, frame.views.size(), device.info());
  } catch (const Error& error) {
    const Strips strips = strips_for(plan, frame, device.info());
    if (!strips.why_not.empty()) throw Error("{} (strips are no way out: {})", error.what(), strips.why_not);
    throw Error("{}; or {}: {} strips of {} rows, each with up to {} more on either side, need {} MiB at a time",
                error.what(), way, strips.count, strips.rows, strips.margin,
                (strips.device_bytes + (1 << 20) - 1) >> 20);
  }
}

}  // namespace gloam
