#include "measure/baselines.h"

#include "gloam/plan.h"
#include "gloam/run.h"
#include "measure/measures.h"
#include "measure/plans.h"

namespace gloam::bench {
namespace {

/// Up to this mean absolute difference the native loop computes the same as gloam.
constexpr double native_tolerance = 1e-4;

Frame depth_and_normals(const Frame& frame, Device& device) {
  Frame out = run(make_plan({.outputs = {"depth", "normal"}}, planes_of(frame), "the frame"), frame, device).frame;
  if (const Plane* given = frame.views.front().find("normal"))
    out.views.front().planes.insert_or_assign("normal", given->clone());
  return out;
}

}  // namespace

PlainFrame::PlainFrame(const Frame& given, Device& device)
    : frame(depth_and_normals(given, device)), planes(device, frame) {}

Baselines::Baselines(Device& device, PlainFrame& plain, const HbaoPlusParams& params, const std::string& reference,
                     const Channel& estimate, std::vector<std::string>& notes)
    : gathers_(device, plain.frame, plain.planes, params),
      copy_(device, plain.frame, plain.planes),
      fma_(device, plain.frame, plain.planes),
      native_(plain.frame, params, widest_instructions()) {
  if (plain.frame.views[0].camera->orthographic) return;
  native_.run();
  const double difference = mean_difference(native_.result(), estimate);
  has_native_ = difference <= native_tolerance;
  if (!has_native_) notes.push_back(differs("native loop", reference, difference));
}

std::string differs(const char* baseline, const std::string& technique, double difference) {
  return fmt::format("the {} differs from {} by {:.2g} on average: no ratio to it", baseline, technique, difference);
}

}  // namespace gloam::bench
