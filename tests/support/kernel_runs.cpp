#include "support/kernel_runs.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "gloam/error.h"
#include "support/light_field.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

using Runs = std::vector<KernelRun>;

/// Loops with more iterations than this, or than by default, read nothing new, and take minutes to interpret.
constexpr int most_turns = 8;

void append(Runs& to, Runs runs) { std::move(runs.begin(), runs.end(), std::back_inserter(to)); }

/// Every value of a choice or a switch, and both ends of a count.
std::vector<int> values_of(const Parameter& p, int usual) {
  if (p.type == Parameter::Type::integer) return {int(p.min), std::min(int(p.max), std::max(usual, most_turns))};
  std::vector<int> all;
  for (int value = int(p.min); value <= int(p.max); ++value) all.push_back(value);
  return all;
}

/// Each choice, switch and count at values other than the default, one at a time.
std::vector<Settings> settings_of(const Technique& technique, Frame& frame) {
  std::vector<Settings> all;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.type == Parameter::Type::floating || p.type == Parameter::Type::file || planned.technique != &technique)
        continue;
      const int usual = int(planned.values.number(p.name));
      for (const int value : values_of(p, usual)) {
        if (value == usual) continue;
        const std::string text = p.type == Parameter::Type::choice    ? p.choices[size_t(value)]
                                 : p.type == Parameter::Type::boolean ? (value ? "on" : "off")
                                                                      : fmt::format("{}", value);
        all.push_back({{technique.name + "." + p.name, text}});
      }
    }
  }
  return all;
}

/// A plan from the planes that a frame has; those that it lacks are invented.
KernelRun planned(const std::string& what, const Frame& frame, const PlanRequest& request) {
  KernelRun run{.what = request.outputs.front() + ", " + what, .frame = clone(frame), .plan = {}};
  run.plan = plan_for(request, run.frame);
  return run;
}

/// Adds a run, unless the technique refuses what is asked for.
void add_if_possible(Runs& runs, const std::string& what, const Frame& frame, const PlanRequest& request) {
  try {
    runs.push_back(planned(what, frame, request));
  } catch (const UsageError&) {
  }
}

/// A frame with all planes that the technique needs.
Frame complete_frame(const Technique& technique, const Shot& shot) {
  Frame frame = shoot(shot, room());
  plan_for(technique, frame);
  return frame;
}

/// With its defaults, and with normals or without.
KernelRun default_run(const Technique& technique, const Shot& shot, bool with_normals, bool all_samples) {
  Frame frame = shoot(shot, room(), with_normals);
  Plan plan = plan_for(technique, frame, all_samples ? Settings{} : few_samples(technique));
  return {
      fmt::format("{}, {}x{}, {}{}", technique.name, shot.width, shot.height,
                  shot.camera.orthographic ? "orthographic" : "perspective", with_normals ? "" : ", without normals"),
      std::move(frame), std::move(plan), with_normals ? Math::precise : Math::fast};
}

/// Variants, on a single row and with few samples otherwise: the defaults run on more rows anyway, and reads outside one row are
/// outside the image.
Runs variant_runs(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  Frame first = shoot(perspective(coverage.width, 1), room());
  for (const Settings& variant : settings_of(technique, first)) {
    Frame frame = shoot(perspective(coverage.width, 1), room());
    Plan plan = plan_for(technique, frame, few_samples(technique) + variant);
    runs.push_back({technique.name + ", " + text_of(variant), std::move(frame), std::move(plan)});
  }
  return runs;
}

/// With a mask that leaves out most pixels, at full and at half resolution; none for a technique that cannot be restricted.
Runs masked_runs(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  Frame frame = complete_frame(technique, perspective(coverage.width, coverage.height));
  plane_of(frame, "mask").channels[0].at(coverage.width / 2, coverage.height / 2) = 1;
  for (const int resolution : {1, 2}) {
    if (resolution > 1 && !coverage.every_setting) continue;
    add_if_possible(runs, fmt::format("masked, resolution 1/{}", resolution), frame,
                    {.outputs = {technique.name},
                     .with = technique.extras,
                     .settings = few_samples(technique),
                     .only = "mask",
                     .resolution = resolution});
  }
  return runs;
}

/// At half resolution, where two views that agree are upsampled together; none for a technique of one view.
Runs reduced_runs(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  if (technique.views != 2) return runs;
  const Frame frame = complete_frame(technique, perspective(coverage.width, coverage.height));
  runs.push_back(planned("resolution 1/2", frame,
                         {.outputs = {technique.name}, .settings = few_samples(technique), .resolution = 2}));
  return runs;
}

/// On modules whose rays change evenly over the image and on others, with views that read one another, and with a mask; none for a
/// technique whose views do not.
Runs module_runs(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  if (!technique.key_views) return runs;
  for (const NamedDisplay& test : display_cases()) {
    Frame frame = shoot_modules(test.display, coverage.width, coverage.height, room());
    for (View& view : frame.views)
      plane_of(view, Layout(coverage.width, coverage.height), "mask").channels[0].at(coverage.width / 2, 0) = 1;
    for (const char* key_views : {"2", "3"}) {
      if (key_views != std::string("2") && !coverage.every_setting) continue;
      const Settings reuse = {{"reuse", "on"}, {"key_views", key_views}};
      PlanRequest request{.outputs = {technique.name}, .settings = few_samples(technique) + reuse};
      runs.push_back(planned(test.name + ", " + text_of(reuse), frame, request));
      if (!coverage.every_setting) continue;
      request.only = "mask";
      runs.push_back(planned(test.name + ", masked, " + text_of(reuse), frame, request));
    }
  }
  return runs;
}

/// A frame with a history; with `motion` its objects have moved.
Frame frame_over_time(const Technique& technique, const Shot& shot, bool with_motion) {
  Frame frame = complete_frame(technique, shot);
  for (const char* plane : {"history_ao", "history_indirect", "history_depth", "history_frames"})
    plane_of(frame, plane);
  if (with_motion) plane_of(frame, "motion");
  for (View& view : frame.views) {
    view.camera->pose = Pose();
    view.camera_before = view.camera;
  }
  return frame;
}

}  // namespace

Runs runs_of(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  const auto add = [&](const Shot& shot, bool with_normals) {
    runs.push_back(default_run(technique, shot, with_normals, coverage.every_setting));
  };
  add(perspective(coverage.width, coverage.height), true);
  if (!is_only_variant(technique)) {
    add(orthographic(coverage.width, coverage.height, 4), false);
    add(perspective(1, 1), true);
  }
  add(perspective(1, 1), false);
  if (coverage.every_setting) append(runs, variant_runs(technique, coverage));
  append(runs, masked_runs(technique, coverage));
  append(runs, reduced_runs(technique, coverage));
  append(runs, module_runs(technique, coverage));
  return runs;
}

Runs runs_of_plans(const Coverage& coverage) {
  Runs runs;
  const Shot shot = perspective(coverage.width, coverage.height);
  Frame frame = shoot(shot, room());
  plane_of(frame, "mask").channels[0].at(coverage.width / 2, coverage.height / 2) = 1;
  runs.push_back(
      planned("masked, elsewhere alchemy", frame, {.outputs = {"ssao"}, .only = "mask", .elsewhere = "alchemy"}));
  runs.push_back(planned("by tiles", frame, {.outputs = {"ssao"}, .preset = "medium", .adaptive = "low"}));
  runs.push_back(planned("masked, by tiles", frame, {.outputs = {"ssao"}, .only = "mask", .adaptive = "low"}));
  for (const bool with_motion : {true, false})
    runs.push_back(planned(with_motion ? "over time, with motion" : "over time",
                           frame_over_time(find_technique("ssao"), shot, with_motion),
                           {.outputs = {"ssao"}, .temporal = true}));
  runs.push_back(planned("light over time", frame_over_time(find_technique("indirect"), shot, true),
                         {.outputs = {"indirect"}, .temporal = true}));
  return runs;
}

Runs runs_of_presets(const Technique& technique, const Coverage& coverage) {
  Runs runs;
  const Shot shot = perspective(coverage.width, coverage.height);
  Frame frame = complete_frame(technique, shot);
  for (const std::string& plane : technique.may_read) {
    if (frame.views[0].find(plane) == nullptr) invent_plane(frame, plane);
  }
  PlanRequest request{.outputs = {technique.name}, .with = technique.extras};
  runs.push_back(planned("defaults", frame, request));
  for (const Preset& preset : technique.presets) {
    request.preset = preset.name;
    runs.push_back(planned("preset " + preset.name, frame, request));
  }
  request.preset = "";
  for (const int resolution : {2, 4}) {
    request.resolution = resolution;
    add_if_possible(runs, fmt::format("resolution 1/{}", resolution), frame, request);
  }
  add_if_possible(runs, "by tiles", frame, {.outputs = {technique.name}, .preset = "high", .adaptive = "low"});
  add_if_possible(runs, "over time", frame_over_time(technique, shot, true),
                  {.outputs = {technique.name}, .temporal = true});
  return runs;
}

}  // namespace gloam::test
