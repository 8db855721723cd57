#include "gloam/automatic.h"

#include <algorithm>

namespace gloam {
namespace {

/// The mask by itself, with the parameters that it has for the technique, and `more` over them.
PlanRequest mask_request(const Technique& technique, const PlanRequest& asked,
                         const std::vector<std::string>& available, const std::string& holds,
                         const std::vector<std::pair<std::string, std::string>>& more) {
  const std::string& mask = technique.effect.mask;
  const Plan whole = make_plan(request_for(technique, asked, true), available, holds);
  PlanRequest request{.outputs = {mask}, .as_cells = true};
  for (const PlannedPass& planned : whole.passes) {
    if (planned.technique->name != mask) continue;
    for (const Parameter& p : planned.technique->parameters)
      request.settings.emplace_back(mask + "." + p.name, planned.values.text(p.name));
    break;
  }
  for (const auto& [name, value] : more) request.settings.emplace_back(mask + "." + name, value);
  return request;
}

double share_above_0(const Frame& frame, const std::string& plane) {
  double above = 0, all = 0;
  for (const View& view : frame.views) {
    const Channel& channel = view.find(plane)->channels.front();
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y) {
      const float* row = channel.row(y);
      above += double(std::count_if(row, row + layout.width, [](float value) { return value > 0; }));
    }
    all += double(layout.width) * layout.height;
  }
  return all > 0 ? above / all : 0;
}

std::string in_percent(double share) { return share < 0.01 ? "less than 1 %" : fmt::format("{:.0f} %", 100 * share); }

}  // namespace

std::vector<const Technique*> techniques_with_effects() {
  std::vector<const Technique*> found;
  for (const Technique& technique : registry()) {
    if (!technique.effect.name.empty()) found.push_back(&technique);
  }
  return found;
}

PlanRequest request_for(const Technique& technique, const PlanRequest& asked, bool with_mask) {
  PlanRequest request = asked;
  request.outputs = {technique.name};
  request.mask = with_mask ? technique.effect.mask : "";
  return request;
}

std::vector<std::string> inputs_of_effect(const Technique& technique, const PlanRequest& asked,
                                          const std::vector<std::string>& available, const std::string& holds) {
  return make_plan(request_for(technique, asked, true), available, holds).inputs;
}

EffectChoice choose(const Technique& technique, const PlanRequest& asked, const Frame& frame,
                    const std::vector<std::string>& available, const std::string& holds, Device& device,
                    const RunOptions& options) {
  EffectChoice choice{.technique = &technique};
  const Effect& effect = technique.effect;
  const auto look = [&](const std::vector<std::pair<std::string, std::string>>& settings) {
    const Plan plan = make_plan(mask_request(technique, asked, available, holds, settings), available, holds);
    RunResult result = run(plan, frame, device, options);
    choice.cells = plan.outputs.front();
    choice.share = share_above_0(result.frame, choice.cells);
    choice.seen = std::move(result.frame);
    return *std::min_element(result.total_ms.begin(), result.total_ms.end());
  };
  choice.classify_ms = look(effect.glance);
  choice.is_everywhere = choice.share > effect.most_share;
  // What a glance overlooks the mask may still find.
  if (choice.share == 0) choice.classify_ms += look({});
  choice.is_wanted = choice.share > 0;
  choice.why = choice.is_wanted ? fmt::format("{} on {} of the image{}", effect.somewhere, in_percent(choice.share),
                                              choice.is_everywhere ? ", so a mask would cost more than it saves" : "")
                                : effect.nowhere;
  return choice;
}

Frame cells_of(const Technique& technique, const PlanRequest& asked, const Frame& frame,
               const std::vector<std::string>& available, const std::string& holds, Device& device) {
  return run(make_plan(mask_request(technique, asked, available, holds, {}), available, holds), frame, device).frame;
}

}  // namespace gloam
