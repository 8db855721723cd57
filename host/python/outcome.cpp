#include "python/outcome.h"

#include "base/lists.h"
#include "base/words.h"
#include "gloam/provenance.h"
#include "gloam/strips.h"
#include "python/frames.h"
#include "python/memory.h"

namespace gloam::python {
namespace {

/// Checks the host's memory; `run` checks the device's.
void check_host_memory(const Plan& plan, const Frame& frame, const Device& device) {
  const Layout layout(frame.width(), frame.height());
  check_memory(bytes_beside_frame(plan, layout, frame.views.size(), device.info().shares_memory),
               fmt::format("{}: {} x {} pixels", plan.technique, frame.width(), frame.height()),
               "use a smaller frame, or ask for less (outputs=[...], resolution='half')");
}

/// The outputs in their order; the layers of a stack by their own names.
std::vector<std::string> written_planes(const Plan& plan, const Frame& result) {
  std::vector<std::string> names;
  for (const std::string& output : plan.outputs) add_new(names, output);
  if (result.views.empty()) return names;
  for (const auto& [name, unused] : result.views.front().planes) add_new(names, name);
  return names;
}

void note_history(const Frame& frame, const Frame& result, const Chained& chained, std::vector<std::string>& notes) {
  if (!knows_where_surfaces_were(frame))
    notes.push_back(
        "temporal: neither a plane 'motion' nor the camera's pose tells where surfaces were in the frame before; each "
        "frame is computed by itself; give the camera of each frame");
  else if (!goes_on_from_before(result))
    notes.push_back(chained.name + ": shows next to nothing that the frame before showed; accumulation begins anew");
}

}  // namespace

SharedFrame carried(SharedFrame frame, bool is_own) {
  if (!is_own) return frame;
  std::vector<std::string> planes = {"depth"};
  if (frame->frame.views.size() == 2) planes.push_back("normal");
  keep_planes(frame->frame, planes);
  return frame;
}

void take_results(Frame&& result, const std::vector<std::string>& written, Outcome& outcome) {
  for (View& view : result.views) {
    ViewValues& values = outcome.views.emplace_back();
    values.view = view.name;
    for (const std::string& name : written) {
      const auto found = view.planes.find(name);
      if (found != view.planes.end()) values.planes.emplace_back(name, values_from(std::move(found->second)));
    }
  }
}

Outcome compute_outcome(const PlanRequest& request, SharedFrame held, bool is_own, Device& device, RunOptions options,
                        Interrupts& interrupts, Chained* chained, std::optional<int> strips) {
  Frame& frame = held->frame;
  const Computation computation = plan_on(request, frame, chained ? history_planes() : std::vector<std::string>());
  const Plan& plan = computation.plan;
  check_host_memory(plan, frame, device);
  Outcome outcome;
  outcome.notes = frame.assumed;
  add_new(outcome.notes, computation.notes);
  const bool goes_on = chained && chained->history.take_over(frame, plan.inputs);
  options.progress = [&](int, int) { interrupts.poll(); };
  if (!strips) check_memory_or_offer_strips(plan, frame, device, "strips='auto'");
  RunResult result = strips
                         ? run_in_strips(plan, frame, device, options, strips_for(plan, frame, device.info(), *strips))
                         : run(plan, frame, device, options);
  if (goes_on) note_history(frame, result.frame, *chained, outcome.notes);
  std::vector<std::string> written = written_planes(plan, result.frame);
  if (chained) {
    if (!chained->written.empty()) written = chained->written;
    chained->history.leave_for_next(frame, result.frame, written, chained->name);
  }
  outcome.technique = plan.technique;
  outcome.device = device.info().name;
  outcome.lanes = result.lanes;
  outcome.passes = std::move(result.passes);
  outcome.total_ms = std::move(result.total_ms);
  outcome.skipped_share = result.skipped_share;
  outcome.device_bytes = result.device_bytes;
  outcome.attributes = provenance({{&plan}}, options);
  for (auto& [name, text] : outcome.attributes) text = on_one_line(text);
  outcome.radius = computation.radius;
  take_results(std::move(result.frame), written, outcome);
  outcome.source = carried(std::move(held), is_own);
  return outcome;
}

}  // namespace gloam::python
