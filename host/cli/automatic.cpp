// gloam auto FRAME.exr -o OUT.exr
#include "plan/automatic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "base/statistics.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/radius.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct AutoCommand {
  std::string out, explain, compression = "zip";
  MaskUse mask = MaskUse::measured;
  bool half = false, measure = false;
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  JsonFlag json;
};

/// An effect from its probe to its planes.
struct Outcome {
  Decision decision;
  std::vector<std::string> outputs;
  std::optional<Plan> plan;  ///< the plan that was run, or would have been
  bool is_masked = false;
  double ms = 0;                                ///< on the device, classification and mask included
  double ms_masked = nan, ms_everywhere = nan;  ///< without classification; NaN: not measured
};

double best(const RunResult& result) {
  return result.total_ms.empty() ? 0 : *std::min_element(result.total_ms.begin(), result.total_ms.end());
}

/// Adds the planes of effects that the frame does not call for: nothing is occluded, nothing is reflected.
void add_idle_planes(const Frame& frame, const std::vector<std::string>& outputs, Frame& out) {
  const Layout layout(frame.width(), frame.height());
  for (View& view : out.views) {
    for (const std::string& name : outputs) {
      const PlaneKind kind = plane_kind(name);
      Plane plane{name, {}};
      for (size_t i = 0; i < kind.components.size(); ++i) {
        Channel& channel = plane.channels.emplace_back(layout);
        for (int y = 0; y < layout.height; ++y) std::fill_n(channel.row(y), layout.width, kind.outside);
        channel.fill_padding(kind.outside);
      }
      view.planes[name] = std::move(plane);
    }
  }
}

void take_planes(Frame& from, Frame& to) {
  for (View& view : from.views) {
    for (auto& [name, plane] : view.planes) to.view(view.name).planes[name] = std::move(plane);
  }
}

/// Also finds the classes of the cells, for a picture of them.
void probe_closely_for_picture(EffectChoice& choice, const EffectProbe& probe) {
  if (choice.is_wanted && !choice.is_everywhere) probe_closely(choice, probe);
}

Outcome outcome_of(const Technique& technique, const AutoCommand& flags, const EffectProbe& probe, Frame& out) {
  Outcome outcome{.decision = decide(technique, probe)};
  EffectChoice& effect = outcome.decision.effect;
  if (!flags.explain.empty()) {
    probe_closely_for_picture(effect, probe);
    for (EffectChoice& refinement : outcome.decision.refinements) probe_closely_for_picture(refinement, probe);
  }
  outcome.ms = effect.classify_ms;
  if (effect.is_wanted) {
    Computed computed = compute(outcome.decision, probe, flags.mask);
    outcome.ms += computed.ms;
    outcome.is_masked = computed.is_masked;
    outcome.ms_masked = computed.ms_masked;
    outcome.ms_everywhere = computed.ms_everywhere;
    take_planes(computed.result.frame, out);
  }
  outcome.plan = make_plan(outcome.decision.request, probe.available, probe.holds);
  outcome.outputs = outcome.plan->outputs;
  if (!effect.is_wanted) add_idle_planes(probe.frame, outcome.outputs, out);
  if (flags.measure && std::isnan(outcome.ms_everywhere)) {
    const Plan everywhere = make_plan(outcome.decision.everywhere, probe.available, probe.holds);
    outcome.ms_everywhere = best(run(everywhere, probe.frame, probe.device, probe.options));
  }
  return outcome;
}

Json number_or_null(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

Json document_of(const EffectChoice& choice) {
  return {{"name", choice.technique->effect.name},
          {"technique", choice.technique->name},
          {"wanted", choice.is_wanted},
          {"everywhere", choice.is_everywhere},
          {"why", choice.why},
          {"share_of_tiles", choice.share}};
}

Json document_of(const std::vector<Outcome>& outcomes, const DeviceInfo& device) {
  Json effects = Json::array();
  double classify_ms = 0, total_ms = 0;
  for (const Outcome& o : outcomes) {
    Json effect = document_of(o.decision.effect);
    effect["runs"] = o.decision.effect.is_wanted ? Json(o.decision.request.outputs.front()) : Json(nullptr);
    effect["ms"] = o.ms;
    effect["ms_everywhere"] = number_or_null(o.ms_everywhere);
    effect["ms_masked"] = number_or_null(o.ms_masked);
    effect["masked"] = o.is_masked;
    effect["refinements"] = Json::array();
    for (const EffectChoice& refinement : o.decision.refinements)
      effect["refinements"].push_back(document_of(refinement));
    effects.push_back(std::move(effect));
    classify_ms += o.decision.effect.classify_ms;
    total_ms += o.ms;
  }
  return {{"effects", effects}, {"classify_ms", classify_ms}, {"total_ms", total_ms}, {"device", device.name}};
}

std::string where(const EffectChoice& choice) {
  if (choice.is_everywhere) return "everywhere";
  return choice.cells.empty() ? "-" : fmt::format("{:.0f} %", 100 * choice.share);
}

std::string milliseconds_or_dash(double ms) { return std::isnan(ms) ? "-" : fmt::format("{:.2f}", ms); }

void print(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows = {
      {"effect", "wanted", "where", "technique", "ms", "masked", "everywhere", "why"}};
  const auto add = [&](const EffectChoice& choice, const std::array<std::string, 3>& ms) {
    rows.push_back({choice.technique->effect.name, choice.is_wanted ? "yes" : "no", where(choice),
                    choice.technique->name, ms[0], ms[1], ms[2], choice.why});
  };
  for (const Outcome& o : outcomes) {
    const bool is_possible = !o.outputs.empty();
    add(o.decision.effect, is_possible ? std::array{milliseconds_or_dash(o.ms), milliseconds_or_dash(o.ms_masked),
                                                    milliseconds_or_dash(o.ms_everywhere)}
                                       : std::array<std::string, 3>{});
    for (const EffectChoice& refinement : o.decision.refinements) add(refinement, {});
  }
  print_table(rows, 8);
}

Explanation explanation_of(const EffectChoice& choice, const std::string& view, const std::string& cost) {
  return {fmt::format("{}: {}", choice.technique->effect.name, choice.is_wanted ? "yes" : "no"), choice.why, cost,
          choice.cells.empty() ? nullptr : choice.seen.view(view).find(choice.cells), choice.is_everywhere};
}

std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view) {
  std::vector<Explanation> all;
  for (const Outcome& o : outcomes) {
    const std::string saving = std::isnan(o.ms_everywhere)
                                   ? fmt::format("{:.1f} ms", o.ms)
                                   : fmt::format("{:.1f} ms, everywhere {:.1f}", o.ms, o.ms_everywhere);
    all.push_back(explanation_of(o.decision.effect, view, o.outputs.empty() ? "" : saving));
    for (const EffectChoice& refinement : o.decision.refinements)
      all.push_back(
          explanation_of(refinement, view, refinement.is_wanted ? "runs as " + refinement.technique->name : ""));
  }
  return all;
}

/// An effect whose planes the frame has, and its request.
struct Candidate {
  const Technique* technique;
  PlanRequest asked;
};

struct Candidates {
  std::vector<Candidate> possible;
  std::vector<Outcome> impossible;  ///< effects that cannot be computed, with the reason
};

bool is_of_display(const FrameFiles& files) {
  for (const FrameFile& file : files.files()) {
    for (const std::string& view : file.views()) {
      const std::optional<Camera> camera = file.camera(view);
      if (camera && camera->slits) return true;
    }
  }
  return false;
}

bool has_effect_for_displays(const std::string& name) {
  const std::vector<const Technique*> all = techniques_with_effects();
  return std::any_of(all.begin(), all.end(),
                     [&](const Technique* t) { return t->effect.for_displays && t->effect.name == name; });
}

Outcome impossible(const Technique& technique, std::string why) {
  Outcome outcome;
  outcome.decision.effect.technique = &technique;
  outcome.decision.effect.why = std::move(why);
  return outcome;
}

/// Throws an error with all reasons if no effect is possible, and for a setting that no effect has.
Candidates candidates_for(const PlanRequest& asked, const FrameFiles& files) {
  Candidates found;
  std::optional<MissingPlanes> missing;
  const bool of_display = is_of_display(files);
  for (const Technique* technique : techniques_with_effects()) {
    if (technique->effect.for_displays && !of_display) continue;
    if (of_display && !technique->any_projection) {
      // Another technique of the same effect may support displays.
      if (!has_effect_for_displays(technique->effect.name))
        found.impossible.push_back(
            impossible(*technique, "its kernels need a single centre of projection, and a display has none"));
      continue;
    }
    try {
      found.possible.push_back({technique, asked_of_effect(*technique, asked, files.common_planes(), holdings(files))});
    } catch (const MissingPlanes& error) {
      if (!missing) missing = error;
      found.impossible.push_back(impossible(*technique, fmt::format("the frame has no '{}'", error.planes.front())));
    }
  }
  if (found.possible.empty()) throw *missing;
  for (const auto& setting : asked.settings) {
    const bool is_known = std::any_of(found.possible.begin(), found.possible.end(), [&](const Candidate& candidate) {
      const auto& settings = candidate.asked.settings;
      return std::find(settings.begin(), settings.end(), setting) != settings.end();
    });
    if (!is_known) found.possible.front().asked.settings.push_back(setting);  // its plan reports the error
  }
  return found;
}

std::vector<std::string> planes_of_every_view(const Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> found;
  for (const std::string& plane : planes) {
    const auto has = [&](const View& view) { return view.find(plane) != nullptr; };
    if (std::all_of(frame.views.begin(), frame.views.end(), has)) found.push_back(plane);
  }
  return found;
}

/// Peak memory: results of each effect stay in memory, and its masked results while it runs without the mask.
unsigned long long bytes_of_auto(const FrameFiles& files, const std::vector<std::string>& planes,
                                 const std::vector<std::vector<Plan>>& effects, bool shares_memory) {
  const Layout layout(files.window().width(), files.window().height());
  const size_t views = files.views().size();
  unsigned long long kept = 0, most = 0;
  for (const std::vector<Plan>& plans : effects) {
    unsigned long long results = 0;
    for (const Plan& plan : plans) {
      const unsigned long long own = bytes_beside_frame(plan, layout, views, false);
      results = std::max(results, own);
      most = std::max(most, own + bytes_beside_frame(plan, layout, views, shares_memory));
    }
    kept += results;
  }
  return process_bytes_with_device + bytes_to_read(files, planes) + kept + most;
}

void auto_command(const AutoCommand& flags) {
  RunOptions options = flags.run_flags.run_options();
  // Times to compare must not include what a device does only once.
  if (flags.measure) options.repeat = std::max(options.repeat, 3);
  const WriteOptions writing{flags.half, flags.compression};
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.explain, "--explain");
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  check_paths(inputs, {{"-o", flags.out}, {"--explain", flags.explain}, {"--json", flags.json.file()}});
  if (!flags.frame.history.empty())
    throw UsageError("--history {}: auto takes nothing over from the frame before; leave it out, or use gloam run",
                     flags.frame.history);
  FrameFiles files = flags.frame.open(flags.frame_flags.read_options());
  const PlanRequest asked = flags.technique_flags.request({});
  Candidates candidates = candidates_for(asked, files);
  std::vector<std::string> planes = {"depth"};
  std::vector<std::vector<Plan>> plans;
  for (const Candidate& candidate : candidates.possible) {
    plans.push_back(plans_of_effect(*candidate.technique, candidate.asked, files.common_planes(), holdings(files)));
    for (const Plan& plan : plans.back()) {
      for (const std::string& plane : plan.inputs) add_new(planes, plane);
    }
  }
  if (!flags.explain.empty() && contains(files.common_planes(), "color")) add_new(planes, "color");
  const unsigned long long memory = planned_memory(
      flags.frame_flags, files.name(), flags.run_flags.device,
      [&](bool shares_memory) { return bytes_of_auto(files, planes, plans, shares_memory); },
      "crop or shrink the frame, ask for --resolution half, or for one view (--view)");
  Device device(flags.run_flags.device);
  Frame frame = files.read(planes);
  note(frame.assumed);
  const Radius made = default_radius(frame, stated_radius(files));
  for (Candidate& candidate : candidates.possible) candidate.asked.radius = made.value;
  const std::vector<std::string> available = planes_of_every_view(frame, planes);
  const std::string holds = holdings(files);
  options.progress = progress_bar();
  Frame out;
  out.display = frame.display;
  out.window = frame.window;
  out.pixel_aspect = frame.pixel_aspect;
  out.assumed = frame.assumed;
  for (const View& view : frame.views)
    out.views.push_back({.name = view.name, .camera = view.camera, .origin = view.origin, .planes = {}});
  std::vector<Outcome> outcomes;
  std::optional<RadiusReport> radius;
  for (const Candidate& candidate : candidates.possible) {
    const EffectProbe probe{candidate.asked, frame, available, holds, device, options};
    outcomes.push_back(outcome_of(*candidate.technique, flags, probe, out));
    if (radius) continue;
    const Plan& plan = *outcomes.back().plan;
    if (const std::optional<Radius> used = radius_of(plan, outcomes.back().decision.request, made.from))
      radius.emplace(*used, frame, cap_of(plan));
  }
  for (Outcome& outcome : candidates.impossible) outcomes.push_back(std::move(outcome));
  std::vector<std::string> written = {flags.out};
  if (!flags.explain.empty()) {
    for (const View& view : frame.views) {
      written.push_back(picture_path(flags.explain, view.name, frame.views.size() > 1).string());
      write_explanation(written.back(), view, explanations_of(outcomes, view.name));
    }
  }
  for (View& view : out.views) view.planes["depth"] = std::move(frame.view(view.name).planes.at("depth"));
  std::vector<MadeBy> made_by;
  for (const Outcome& o : outcomes)
    if (o.plan) made_by.push_back({&*o.plan, o.decision.effect.is_wanted});
  out.attributes = provenance(made_by, options);
  write_frame(flags.out, out, writing);
  Json document = document_of(outcomes, device.info());
  document["memory_bytes"] = memory;
  if (radius) radius->add_to(document);
  flags.json.write(document, written);
  if (flags.json.only_json()) return;
  print(outcomes);
  if (radius) radius->print();
  for (const std::string& path : written) fmt::print("wrote {}\n", printable(path));
}

}  // namespace

void add_auto(CLI::App& app) {
  auto flags = std::make_shared<AutoCommand>();
  CLI::App* command = app.add_subcommand("auto", "look at a frame, and compute only the effects that it calls for");
  flags->frame.add_to(*command);
  command->add_option("-o,--output", flags->out, "EXR file to write")->required()->type_name("OUT.exr");
  command->add_option("--explain", flags->explain, "picture of what is called for where, and why")
      ->type_name("OUT.png");
  add_choice(*command, "--mask", flags->mask,
             {{"measured", MaskUse::measured}, {"always", MaskUse::always}, {"never", MaskUse::never}},
             "whether an effect is computed only where the frame calls for it; measured (the default): both ways are "
             "timed, 3 rounds in turn, and the mask is used where it saves 5 % or more");
  command->add_flag("--measure", flags->measure,
                    "also compute everything everywhere, and tell what that takes; 3 timed runs at least");
  command->add_flag("--half", flags->half, "write results as half instead of float");
  add_compression(*command, flags->compression);
  flags->technique_flags.add_to(*command, false);
  flags->run_flags.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "What a frame does not call for is written as if computed: AO of 1, reflections of 0.\n"
      "Examples:\n"
      "  gloam auto frame.exr -o out.exr\n"
      "  gloam auto frame.exr -o out.exr --explain why.png --measure --repeat 9\n"
      "Parameters are set with --set NAME=VALUE (gloam list techniques).");
  command->callback([flags] { auto_command(*flags); });
}

}  // namespace gloam::cli
