#include "sequence/history_chain.h"

#include "base/lists.h"
#include "gloam/history.h"
#include "gloam/plan.h"

namespace gloam {

bool HistoryChain::take_over(Frame& frame, const std::vector<std::string>& inputs) {
  const bool goes_on = before_.has_value();
  if (goes_on)
    add_history(frame, std::move(*before_), inputs, name_);
  else
    add_no_history(frame, inputs);
  before_.reset();
  return goes_on;
}

void HistoryChain::leave_for_next(const Frame& frame, Frame& result, const std::vector<std::string>& written,
                                  const std::string& name) {
  before_.emplace();
  name_ = name;
  before_->window = result.window;
  before_->display = result.display;
  for (View& view : result.views) {
    View& kept = before_->views.emplace_back();
    kept.name = view.name;
    kept.camera = view.camera;
    for (const std::string& plane : planes_for_history()) {
      const bool is_written = contains(written, plane);
      if (view.find(plane))
        kept.planes[plane] = is_written ? view.find(plane)->clone() : std::move(view.planes.at(plane));
    }
    if (!kept.find("depth")) kept.planes["depth"] = frame.view(view.name).find("depth")->clone();
  }
  keep_planes(result, written);
}

std::vector<std::string> with_planes_for_history(std::vector<std::string> outputs, const std::string& technique) {
  for (const std::string& name : planes_for_history()) {
    if (contains(outputs_of(find_technique(technique)), name)) add_new(outputs, name);
  }
  return outputs;
}

bool motion_leads_elsewhere(const std::vector<std::string>& inputs, int before, int number) {
  return contains(inputs, "motion") && before + 1 != number;
}

int seed_in_sequence(int seed, int frame_number) {
  return int((unsigned(seed) + unsigned(frame_number)) & 0x7fffffffu);
}

}  // namespace gloam
