// gloam.auto
#include "gloam/auto.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "auto/mask_words.h"
#include "auto/report.h"
#include "base/lists.h"
#include "frame/untouched.h"
#include "planner/goal.h"
#include "python/files.h"
#include "python/frames.h"
#include "python/memory.h"
#include "python/outcome.h"
#include "python/requests.h"
#include "sequence/auto_files.h"

namespace gloam::python {
namespace {

/// What is asked for beside the request.
struct AutoWords {
  MaskUse mask = MaskUse::measured;
  Goal goal;
  bool measures = false, composes = false;
  std::optional<ColorHolds> holds;
  std::optional<std::array<double, 3>> ambient;
};

AutoWords auto_words(const py::dict& words) {
  AutoWords asked;
  asked.goal = goal_of(words);
  check_one_goal(asked.goal);
  if (const auto mask = py::cast<std::optional<std::string>>(words["mask"]))
    asked.mask = value_of(*mask, "mask", mask_words);
  asked.measures = py::cast<bool>(words["measure"]);
  asked.composes = py::cast<bool>(words["composite"]);
  if (const auto holds = py::cast<std::optional<std::string>>(words["color_holds"]))
    asked.holds = parse_color_holds(*holds, "color_holds");
  asked.ambient = py::cast<std::optional<std::array<double, 3>>>(words["ambient"]);
  return asked;
}

/// How a frame's light is counted, with a note on what is assumed.
ComposeOptions composing_of(const AutoWords& asked, const Frame& frame, std::vector<std::string>& notes) {
  if (!contains(common_planes(frame), "color")) {
    if (asked.holds || asked.ambient || asked.composes)
      throw UsageError("{}: the frame has no colour; give the plane color", asked.composes ? "composite"
                                                                            : asked.holds  ? "color_holds"
                                                                                           : "ambient");
    return {};
  }
  ComposeOptions composing{{}, asked.ambient, {}};
  const auto stated = frame.attributes.find(color_holds_attribute);
  if (asked.holds)
    composing.holds = *asked.holds;
  else if (stated != frame.attributes.end())
    composing.holds = parse_color_holds(stated->second, stated->first);
  else if (asked.goal || asked.composes)
    notes.push_back(note_on_assumed_holds());
  return composing;
}

AutoPurpose purpose_of(const AutoWords& asked, const ComposeOptions& composing) {
  return {.looks_at_picture = asked.goal || asked.composes, .composing = composing};
}

/// What gloam.auto gives back: the outcome, what the command writes as JSON, and the composite, if any.
struct AutoOutcome {
  Outcome outcome;
  nlohmann::ordered_json facts;
  SharedFrame composite;
};

/// The picture, of the colour as the frame has it.
void compose_picture(const Frame& frame, const Frame& computed, const ComposeOptions& composing, AutoOutcome& made) {
  made.composite = std::make_shared<HeldFrame>(HeldFrame{copy_of(frame, planes_to_compose()), ""});
  leave_out_other_light(made.composite->frame, made.outcome.notes);
  const Composition composition = compose(made.composite->frame, computed, composing);
  keep_planes(made.composite->frame, {"color"});
  made.facts["composite"] = composition_document(composition);
  made.facts["not_darkened"] = composition.untouched;
  add_new(made.outcome.notes, composition.notes);
}

AutoOutcome compute_auto_outcome(const PlanRequest& request, SharedFrame held, bool is_own, Device& device,
                                 RunOptions options, const AutoWords& asked, Interrupts& interrupts) {
  const Frame& frame = held->frame;
  AutoOutcome made;
  made.outcome.notes = frame.assumed;
  AutoSettings settings{.mask = asked.mask, .measures = asked.measures, .goal = asked.goal};
  settings.purpose = purpose_of(asked, composing_of(asked, frame, made.outcome.notes));
  check(frame);
  check_memory(bytes_beside_frame(plan_auto(facts_of(frame), request, settings.purpose), device.info().shares_memory),
               fmt::format("auto: {} x {} pixels", frame.width(), frame.height()), "use a smaller frame");
  options.progress = settings.measuring = [&](int, int) { interrupts.poll(); };
  if (asked.measures) options.repeat = std::max(options.repeat, 3);
  AutoResult result = compute_auto(frame, request, settings, device, options);
  made.facts = document_of(result, asked.goal, device.info());
  add_new(made.outcome.notes, result.notes);
  if (asked.composes) compose_picture(frame, result.frame, settings.purpose.composing, made);
  Outcome& outcome = made.outcome;
  outcome.technique = "auto";
  outcome.device = device.info().name;
  outcome.total_ms = {made.facts.at("total_ms").get<double>()};
  outcome.attributes = result.frame.attributes;
  for (auto& [name, text] : outcome.attributes) text = on_one_line(text);
  outcome.radius = result.used_radius;
  const std::vector<std::string> planes = common_planes(result.frame);
  take_results(std::move(result.frame), planes, outcome);
  outcome.source = carried(std::move(held), is_own);
  return made;
}

py::tuple auto_on(const py::dict& request_words, const SharedFrame& frame, bool is_own,
                  const std::shared_ptr<Device>& device, const py::dict& option_words, const py::dict& more_words) {
  const PlanRequest request = plan_request(request_words);
  const RunOptions options = run_options(option_words);
  const AutoWords asked = auto_words(more_words);
  AutoOutcome made = without_lock([&](Interrupts& interrupts) {
    return compute_auto_outcome(request, frame, is_own, *device, options, asked, interrupts);
  });
  return py::make_tuple(std::move(made.outcome), text_of(made.facts.dump()), made.composite);
}

/// A frame of files with the planes that its effects may read.
SharedFrame read_for_auto(const std::vector<std::string>& paths, const py::dict& words, const py::dict& request_words,
                          const py::dict& more_words) {
  const ReadOptions options = read_options(words);
  const PlanRequest request = plan_request(request_words);
  const std::optional<Camera> camera = given_camera(words);
  const AutoWords asked = auto_words(more_words);
  return without_lock([&](Interrupts&) {
    FrameFiles files(paths, options);
    std::vector<std::string> notes;
    const ColorHolds holds = asked.holds ? *asked.holds : holds_of(files, notes);
    AutoFrame planned = planned_auto(std::move(files), request, purpose_of(asked, {holds, asked.ambient, {}}));
    std::vector<std::string> planes = planned.planes;
    std::erase_if(planes, [&](const std::string& plane) { return !contains(planned.facts.planes, plane); });
    return read_frame(planned.files, planes, camera);
  });
}

}  // namespace

void add_auto(py::module_& module) {
  module.def("auto", &auto_on);
  module.def("read_for_auto", &read_for_auto);
}

}  // namespace gloam::python
