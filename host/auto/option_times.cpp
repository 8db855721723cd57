#include "auto/option_times.h"

#include <algorithm>

#include "auto/changes.h"
#include "base/statistics.h"
#include "frame/subsample.h"
#include "gloam/planes.h"
#include "plan/resample.h"

namespace gloam {
namespace {

/// Pixels that are computed quickly by any option.
constexpr double most_quick_pixels = 1 << 19;

/// The frame at another size than the glance's, so that what passes take to start can be told from what pixels take: finer where that is quick,
/// as it is nearer to the frame's own size, else coarser.
Frame beside_the_glance(const Frame& frame, const Frame& small) {
  const int finer = scale_of_glance(frame) / 2;
  const FrameSize size = size_of(frame);
  if (finer >= 1 && size.pixels * size.views <= most_quick_pixels * finer * finer)
    return every_nth_pixel(frame, finer, common_planes(frame));
  return every_nth_pixel(small, 2, common_planes(small));
}

std::vector<const EffectOption*> unknown_options(const std::vector<BudgetedEffect>& effects, const FrameSize& size,
                                                 const OptionSpeeds& speeds) {
  std::vector<const EffectOption*> unknown;
  for (const BudgetedEffect& effect : effects)
    for (const EffectOption& option : effect.options)
      if (!speeds.knows(option.label(), size)) unknown.push_back(&option);
  return unknown;
}

void measure_options(const std::vector<const EffectOption*>& options, const BudgetMeans& means, OptionSpeeds& speeds) {
  const Frame& small = means.glance.small();
  const Frame other = beside_the_glance(means.frame, small);
  for (size_t i = 0; i < options.size(); ++i) {
    if (means.measuring) means.measuring(int(i), int(options.size()));
    const Plan plan = make_plan(options[i]->request, means.available, means.holds);
    for (const Frame* frame : {&small, &other})
      speeds.add(options[i]->label(), size_of(*frame), median(timed(*options[i], plan, *frame, means).total_ms));
  }
  if (means.measuring) means.measuring(int(options.size()), int(options.size()));
}

/// What upsampling reads of a frame, and of the look.
Frame with_seen(const Frame& frame, const Upsampling& left, const Plan& plan, const BudgetMeans& means) {
  Frame both = with_planes(frame, left.plan.inputs);
  const Layout reduced_size = reduced(Layout(frame.width(), frame.height()), plan.resolution);
  for (View& view : both.views) {
    for (size_t i = 0; i < left.given.size(); ++i) {
      const std::string& name = left.given[i];
      Plane plane = &frame == &means.frame ? means.glance.parts().view(view.name).find(plan.outputs[i])->clone()
                                           : empty_plane(name, reduced_size);
      plane.name = name;
      view.planes[name] = std::move(plane);
    }
  }
  return both;
}

}  // namespace

RunResult timed(const Plan& plan, const Frame& frame, const BudgetMeans& means) {
  RunOptions options = means.options;
  options.repeat = std::max(3, means.options.repeat);
  return run(plan, frame, means.device, options);
}

RunResult timed(const EffectOption& option, const Plan& plan, const Frame& frame, const BudgetMeans& means) {
  if (!option.is_seen) return timed(plan, frame, means);
  const Upsampling left = *upsampling_of(plan);
  return timed(left.plan, with_seen(frame, left, plan, means), means);
}

void expect_times(std::vector<BudgetedEffect>& effects, const BudgetMeans& means, OptionSpeeds& speeds) {
  const FrameSize size = size_of(means.frame);
  const std::vector<const EffectOption*> unknown = unknown_options(effects, size, speeds);
  if (!unknown.empty()) measure_options(unknown, means, speeds);
  for (BudgetedEffect& effect : effects) {
    effect.expected_ms.clear();
    for (const EffectOption& option : effect.options)
      effect.expected_ms.push_back(speeds.expected_ms(option.label(), size));
  }
}

}  // namespace gloam
