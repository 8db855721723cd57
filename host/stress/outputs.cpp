#include "stress/outputs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "gloam/planes.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

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

/// Adds a second view equal to the first: a property of one view holds for both.
void add_second_view(Frame& frame) {
  View& first = frame.views.front();
  if (first.name.empty()) first.name = "first";
  if (!first.camera->pose) first.camera->pose = Pose{};
  View second = without_planes(first);
  second.name = "second";
  for (const auto& [name, plane] : first.planes) second.planes.emplace(name, plane.clone());
  frame.views.push_back(std::move(second));
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

/// Describes a pixel whose value its kind does not allow; empty if all is well.
std::string violation_at(const Plane& plane, PlaneKind::Meaning meaning, int x, int y) {
  for (const Channel& channel : plane.channels) {
    if (!allowed(meaning, channel.at(x, y))) return fmt::format("{}", channel.at(x, y));
  }
  if (meaning != PlaneKind::unit_vector || unit_or_zero(plane, x, y)) return "";
  return fmt::format("({}, {}, {}), which is not unit", plane.channels[0].at(x, y), plane.channels[1].at(x, y),
                     plane.channels[2].at(x, y));
}

}  // namespace

Settings operator+(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : ", ") + name + " = " + value;
  return text.empty() ? "defaults" : text;
}

std::string exact(double value) { return std::isinf(value) ? "inf" : fmt::format("{:.17g}", value); }

std::vector<int> usual_lanes(const Device& device) {
  const int own = device.info().tuning.lanes;
  return own == 1 ? std::vector<int>{1} : std::vector<int>{1, own};
}

std::vector<RunOptions> two_ways(const Device& device) {
  return {{.math = Math::fast, .lanes = usual_lanes(device).back()}, {.math = Math::precise, .lanes = 1}};
}

Plan plan_for(const Technique& technique, Frame& frame, const Settings& settings) {
  PlanRequest request;
  request.outputs = {technique.name};
  request.settings = settings;
  return plan_for(request, frame);
}

Plan plan_for(const PlanRequest& request, Frame& frame) {
  for (;;) {
    try {
      Plan plan = make_plan(request, plane_names(frame), "the rest is invented");
      if (find_technique(request.outputs.front()).views > int(frame.views.size())) add_second_view(frame);
      return plan;
    } catch (const MissingPlanes& missing) {
      for (const std::string& plane : missing.planes) invent_plane(frame, plane);
    }
  }
}

Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 Device& device) {
  const Plan plan = plan_for(technique, frame, settings);
  return std::move(run(plan, frame, device, options).frame);
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

namespace {

/// Planning refuses some choices for some techniques (plan/relevant_map.h).
bool is_refused(const Technique& technique, const Frame& frame, const Settings& settings) {
  try {
    make_plan({.outputs = {technique.name}, .settings = settings}, plane_names(frame), "the rest is invented");
  } catch (const MissingPlanes&) {
    return false;
  } catch (const UsageError&) {
    return true;
  }
  return false;
}

}  // namespace

std::vector<Settings> variants(const Technique& technique, Frame& frame) {
  const Settings few = few_samples(technique);
  std::vector<Settings> all = {{}};
  std::vector<std::string> seen;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.type != Parameter::Type::choice && p.type != Parameter::Type::boolean) continue;
      const std::string name = planned.technique->name + "." + p.name;
      if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
      seen.push_back(name);
      for (int value = int(p.min); value <= int(p.max); ++value) {
        if (value == int(planned.values.number(p.name))) continue;
        const std::string text = p.type == Parameter::Type::boolean ? (value ? "on" : "off") : p.choices[size_t(value)];
        const Settings variant = few + Settings{{name, text}};
        if (!is_refused(technique, frame, variant)) all.push_back(variant);
      }
    }
  }
  return all;
}

std::vector<std::string> unit_interval_outputs(const Plan& plan) {
  std::vector<std::string> planes;
  for (const std::string& name : plan.outputs) {
    const bool given = std::find(plan.inputs.begin(), plan.inputs.end(), name) != plan.inputs.end();
    if (!given && plane_kind(name).meaning == PlaneKind::unit_interval) planes.push_back(name);
  }
  return planes;
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
        const float one = a.channels[i].at(x, y), other = b.channels[i].at(x, y);
        const double here = difference_of(one, other);
        if (here > d.max) d.place = {"", a.name, x, y, fmt::format("{} against {}", one, other)}, d.max = here;
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
      if (d.max > worst.max) worst.max = d.max, worst.place = d.place, worst.place.view = a.views[i].name;
      worst.mean = std::max(worst.mean, d.mean);
    }
  }
  return worst;
}

double share_over(const Frame& a, const Frame& b, double limit) {
  double over = 0, all = 0;
  for (size_t i = 0; i < a.views.size(); ++i) {
    for (const auto& [name, plane] : a.views[i].planes) {
      for (size_t c = 0; c < plane.channels.size(); ++c) {
        const Channel &one = plane.channels[c], &other = b.views[i].find(name)->channels[c];
        for (int y = 0; y < a.height(); ++y) {
          for (int x = 0; x < a.width(); ++x) {
            const float p = one.at(x, y), q = other.at(x, y);
            over += p != q && !(std::abs(p - q) <= limit);
            ++all;
          }
        }
      }
    }
  }
  return over / std::max(all, 1.0);
}

Place first_violation(const Frame& frame) {
  for (const View& view : frame.views) {
    for (const auto& [name, plane] : view.planes) {
      const PlaneKind::Meaning meaning = plane_kind(name).meaning;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const std::string held = violation_at(plane, meaning, x, y);
          if (!held.empty()) return {view.name, name, x, y, held};
        }
      }
    }
  }
  return {};
}

std::string violation(const Frame& frame) {
  const Place place = first_violation(frame);
  return place.plane.empty() ? "" : fmt::format("{} = {} at ({}, {})", place.plane, place.holds, place.x, place.y);
}

Difference distance_from_open(const Plan& plan, const Frame& outputs) {
  Difference worst;
  for (const View& view : outputs.views) {
    for (const std::string& name : unit_interval_outputs(plan)) {
      const Plane* plane = view.find(name);
      if (!plane) continue;  // techniques for the first of two views make only its plane
      const Channel& values = plane->channels[0];
      const float nothing = plane_kind(name).outside;
      for (int y = 0; y < outputs.height(); ++y) {
        for (int x = 0; x < outputs.width(); ++x) {
          const double here = difference_of(values.at(x, y), nothing);
          if (here <= worst.max) continue;
          worst.max = here;
          worst.place = {view.name, name, x, y, fmt::format("{}", values.at(x, y))};
        }
      }
    }
  }
  return worst;
}

}  // namespace gloam::stress
