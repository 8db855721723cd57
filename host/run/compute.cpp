#include "gloam/compute.h"

#include <algorithm>

#include "gloam/error.h"
#include "gloam/radius.h"

namespace gloam {
namespace {

std::vector<std::string> common_planes(const Frame& frame) {
  std::vector<std::string> names;
  if (frame.views.empty()) return names;
  for (const auto& [name, unused] : frame.views.front().planes) {
    const bool all_have = std::all_of(frame.views.begin(), frame.views.end(),
                                      [&name = name](const View& view) { return view.find(name); });
    if (all_have) names.push_back(name);
  }
  return names;
}

std::string holdings(const std::vector<std::string>& planes) {
  return planes.empty() ? "the frame has no plane" : "the frame has only " + enumerate(planes);
}

std::optional<double> stated_radius(const Frame& frame) {
  const auto stated = frame.numbers.find("aoRadius");
  return stated == frame.numbers.end() ? std::nullopt : std::optional(stated->second);
}

}  // namespace

RunResult compute(const PlanRequest& request, const Frame& frame, Device& device, const RunOptions& options) {
  check(frame);
  const std::vector<std::string> planes = common_planes(frame);
  PlanRequest with_radius = request;
  if (!request.radius) with_radius.radius = default_radius(frame, stated_radius(frame)).value;
  return run(make_plan(with_radius, planes, holdings(planes)), frame, device, options);
}

std::vector<float> ambient_occlusion(const Arrays& arrays, Device& device, const PlanRequest& request,
                                     const RunOptions& options) {
  PlanRequest for_ao = request;
  if (for_ao.outputs.empty()) for_ao.outputs = {"ao"};
  return values_of(compute(for_ao, frame_from(arrays), device, options).frame, "ao");
}

}  // namespace gloam
