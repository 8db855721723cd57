#include "support/techniques.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>

#include "gloam/error.h"
#include "gloam/files.h"
#include "gloam/planes.h"
#include "kernel_sources.h"
#include "support/frames.h"

namespace gloam::test {
namespace {

/// Set by tests/CMakeLists.txt for tests that need no second device.
constexpr const char* one_opencl = "GLOAM_ONE_OPENCL";

/// Has to happen before the first OpenCL call of the process.
void switch_on_rusticl() {
  if (!std::getenv(one_opencl)) setenv("RUSTICL_ENABLE", "llvmpipe", 0);
}

/// As text that a parameter reads back to the same value.
std::string exact(double value) { return std::isinf(value) ? "inf" : fmt::format("{:.17g}", value); }

double difference_of(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  return std::isfinite(a) && std::isfinite(b) ? std::abs(double(a) - double(b))
                                              : std::numeric_limits<double>::infinity();
}

bool allowed(PlaneKind::Meaning meaning, float value) {
  if (meaning == PlaneKind::unit_interval) return value >= 0 && value <= 1;
  if (meaning == PlaneKind::view_depth) return value > 0;  // +inf is background
  if (meaning == PlaneKind::length) return std::isfinite(value) && value >= 0;
  return std::isfinite(value);
}

bool unit_or_zero(const Plane& plane, int x, int y) {
  double square = 0;
  for (const Channel& channel : plane.channels) square += double(channel.at(x, y)) * double(channel.at(x, y));
  return square == 0 || std::abs(std::sqrt(square) - 1) < 1e-5;
}

}  // namespace

Device& device(const std::string& text) {
  switch_on_rusticl();
  // Never closed: OpenCL drivers are not all alive any more when statics are destroyed.
  static auto& open = *new std::map<std::string, Device*>;
  Device*& found = open[text];
  if (!found) found = new Device(text);
  return *found;
}

bool has_device(const std::string& text) {
  if (std::getenv(one_opencl))
    throw Error("has_device: {} is set, so '{}' is not looked for; tests that need it are called *SecondDevice*",
                one_opencl, text);
  switch_on_rusticl();
  const std::vector<DeviceInfo> all = list_devices();
  return std::any_of(all.begin(), all.end(),
                     [&](const DeviceInfo& info) { return info.name.find(text) != std::string::npos; });
}

std::vector<int> usual_lanes(Device& device) {
  const int own = device.info().lanes;
  return own == 1 ? std::vector<int>{1} : std::vector<int>{1, own};
}

namespace {

/// A second view that shows the same from the same place: what holds for one view holds for both.
void add_second_view(Frame& frame) {
  View& first = frame.views.front();
  if (first.name.empty()) first.name = "first";
  if (!first.camera->pose) first.camera->pose = Pose{};
  View second{.name = "second", .camera = first.camera, .origin = first.origin, .planes = {}};
  for (const auto& [name, plane] : first.planes) second.planes.emplace(name, plane.clone());
  frame.views.push_back(std::move(second));
}

}  // namespace

Plan plan_for(const Technique& technique, Frame& frame, const Settings& settings) {
  PlanRequest request;
  request.outputs = {technique.name};
  request.settings = settings;
  for (;;) {
    try {
      Plan plan = make_plan(request, plane_names(frame), "the test has invented the rest");
      if (technique.views > int(frame.views.size())) add_second_view(frame);
      return plan;
    } catch (const MissingPlanes& missing) {
      for (const std::string& plane : missing.planes) invent_plane(frame, plane);
    }
  }
}

Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 const std::string& device_name) {
  const Plan plan = plan_for(technique, frame, settings);
  return std::move(run(plan, frame, device(device_name), options).frame);
}

Settings set_lengths(const Technique& technique, Frame& frame, const std::function<double(double)>& value) {
  Settings settings;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.unit != "scene units") continue;
      const double initial = planned.values.number(p.name);
      settings.emplace_back(planned.technique->name + "." + p.name, exact(std::clamp(value(initial), p.min, p.max)));
    }
  }
  return settings;
}

Settings few_samples(const Technique& technique) {
  Settings settings;
  for (const Preset& preset : technique.presets) {
    if (preset.name != "low") continue;
    for (const auto& [name, value] : preset.settings) settings.emplace_back(technique.name + "." + name, value);
  }
  return settings;
}

std::vector<std::string> unit_interval_outputs(const Plan& plan) {
  std::vector<std::string> planes;
  for (const std::string& name : plan.outputs) {
    const bool given = std::find(plan.inputs.begin(), plan.inputs.end(), name) != plan.inputs.end();
    if (!given && plane_kind(name).meaning == PlaneKind::unit_interval) planes.push_back(name);
  }
  return planes;
}

bool same_bits(const Plane& a, const Plane& b) {
  for (size_t i = 0; i < a.channels.size(); ++i) {
    const Layout& layout = a.channels[i].layout();
    for (int y = 0; y < layout.height; ++y) {
      if (std::memcmp(a.channels[i].row(y), b.channels[i].row(y), size_t(layout.width) * sizeof(float)) != 0)
        return false;
    }
  }
  return true;
}

bool same_bits(const Frame& a, const Frame& b) {
  if (plane_names(a) != plane_names(b) || a.width() != b.width() || a.height() != b.height()) return false;
  return a.views.size() == b.views.size() &&
         std::equal(a.views.begin(), a.views.end(), b.views.begin(), [](const View& one, const View& other) {
           return std::all_of(one.planes.begin(), one.planes.end(),
                              [&](const auto& named) { return same_bits(named.second, *other.find(named.first)); });
         });
}

Difference difference(const Plane& a, const Plane& b) {
  Difference d;
  double count = 0;
  for (size_t i = 0; i < a.channels.size(); ++i) {
    const Layout& layout = a.channels[i].layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        const double here = difference_of(a.channels[i].at(x, y), b.channels[i].at(x, y));
        d.max = std::max(d.max, here);
        d.mean += here;
        ++count;
      }
    }
  }
  d.mean /= std::max(count, 1.0);
  return d;
}

Difference difference(const Frame& a, const Frame& b) {
  Difference worst;
  for (size_t i = 0; i < a.views.size(); ++i) {
    for (const auto& [name, plane] : a.views[i].planes) {
      const Difference d = difference(plane, *b.views.at(i).find(name));
      worst.max = std::max(worst.max, d.max);
      worst.mean = std::max(worst.mean, d.mean);
    }
  }
  return worst;
}

std::string violation(const View& view) {
  for (const auto& [name, plane] : view.planes) {
    const PlaneKind kind = plane_kind(name);
    const Layout& layout = plane.channels[0].layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        for (const Channel& channel : plane.channels) {
          if (!allowed(kind.meaning, channel.at(x, y)))
            return fmt::format("{} = {} at ({}, {})", name, channel.at(x, y), x, y);
        }
        if (kind.meaning == PlaneKind::unit_vector && !unit_or_zero(plane, x, y)) {
          return fmt::format("{} = ({}, {}, {}) at ({}, {}) is not unit", name, plane.channels[0].at(x, y),
                             plane.channels[1].at(x, y), plane.channels[2].at(x, y), x, y);
        }
      }
    }
  }
  return "";
}

std::string violation(const Frame& frame) {
  for (const View& view : frame.views) {
    if (const std::string found = violation(view); !found.empty()) return found;
  }
  return "";
}

std::string identifier(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      text += c;
    else
      text += c == '+' ? "_plus" : "_";
  }
  return text;
}

std::string kernel_text(const Technique& technique) { return kernel_sources().at(technique.source); }

}  // namespace gloam::test
