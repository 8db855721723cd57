// gloam auto FRAME.exr -o OUT.exr
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "cli/auto_frame.h"
#include "cli/auto_shot.h"
#include "cli/given_flags.h"
#include "cli/memory.h"
#include "cli/shot.h"
#include "gloam/error.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

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

void run_on_one_frame(const AutoCommand& flags) {
  RunOptions options = flags.run_flags.run_options();
  // Times to compare must not include what a device does only once.
  if (flags.measure) options.repeat = std::max(options.repeat, 3);
  const WriteOptions writing{flags.half, flags.compression};
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  check_paths(inputs, {{"-o", flags.out},
                       {"--composite", flags.composite.path},
                       {"--explain", flags.explain},
                       {"--json", flags.json.file()}});
  const bool explains = !flags.explain.empty();
  AutoFrame planned =
      planned_auto(flags.frame.open(flags.frame_flags.read_options()), flags.technique_flags.request({}), explains);
  std::optional<CompositeSource> source =
      open_composite(flags.composite, flags.frame.files(), flags.frame_flags.read_options());
  const unsigned long long memory = planned_memory(
      flags.frame_flags, planned.files.name(), flags.run_flags.device,
      [&](bool shares_memory) { return bytes_of_auto(planned, shares_memory) + bytes_of(source); },
      "crop or shrink the frame, ask for --resolution half, or for one view (--view)");
  Device device = flags.run_flags.open();
  Frame frame = planned.files.read(planned.planes);
  note(frame.assumed);
  const Radius made = default_radius(frame, stated_radius(planned.files));
  set_radius(planned, made.value);
  options.progress = progress_bar();
  AutoResult result = compute_effects(
      planned, {flags.mask.value_or(MaskUse::measured), flags.measure, explains, made.from}, frame, device, options);
  std::vector<std::string> written = {flags.out};
  if (explains) {
    for (const View& view : frame.views) {
      written.push_back(picture_path(flags.explain, view.name, frame.views.size() > 1).string());
      write_explanation(written.back(), view, explanations_of(result.outcomes, view.name));
    }
  }
  std::optional<Composition> composition;
  if (source) {
    read_colour(*source);
    const Composite composite = make_composite(*source, result.frame);
    composition = composite.composition;
    note(composition->notes);
    write_composite(flags.composite.path, composite, flags.compression);
    written.push_back(flags.composite.path);
  }
  for (View& view : result.frame.views) view.planes["depth"] = std::move(frame.view(view.name).planes.at("depth"));
  write_frame(flags.out, result.frame, writing);
  Json document = document_of(result.outcomes, device.info());
  document["memory_bytes"] = memory;
  if (composition) document["composite"] = composition_document(*composition);
  if (result.radius) result.radius->add_to(document);
  flags.json.write(document, written);
  if (flags.json.only_json()) return;
  print(result.outcomes);
  if (result.radius) result.radius->print();
  if (composition) fmt::print("{}\n", composition_in_words(*composition));
  for (const std::string& path : written) fmt::print("wrote {}\n", printable(path));
}

void auto_command(const AutoCommand& given, const CLI::App& command) {
  AutoCommand flags = given;
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.explain, "--explain");
  if (!flags.composite.path.empty()) check_frame_name(flags.composite.path, "--composite");
  if (!flags.frame.history.empty())
    throw UsageError("--history {}: auto takes nothing over from the frame before; leave it out, or use gloam run",
                     flags.frame.history);
  if (flags.frame.has_pattern()) {
    flags.given = contents_in_words(command);
    return run_auto_on_shot(flags);
  }
  check_no_shot(flags.frame, {{"-o", flags.out}, {"--composite", flags.composite.path}}, flags.shot.any());
  run_on_one_frame(flags);
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
             "timed, 3 rounds in turn, and the mask is used where it saves 5 % or more; of a shot: never");
  command->add_flag("--measure", flags->measure,
                    "also compute everything everywhere, and tell what that takes; 3 timed runs at least");
  CLI::Option* half = command->add_flag("--half", flags->half, "write results as half instead of float");
  add_compression(*command, flags->compression);
  flags->technique_flags.add_to(*command, false);
  flags->run_flags.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->shot.add_to(*command, false);
  flags->composite.add_to(*command);
  command->get_option("--float")->excludes(half);
  flags->json.add_to(*command);
  command->footer(
      "What a frame does not call for is written as if computed: AO of 1, reflections of 0.\n"
      "Examples:\n"
      "  gloam auto frame.exr -o out.exr\n"
      "  gloam auto frame.exr -o out.exr --explain why.png --measure --repeat 9\n"
      "  gloam auto frame.exr -o out.exr --composite picture.exr\n"
      "  gloam auto 'shot.####.exr' -o 'out.####.exr' --frames 1-48 --radius 0.5\n"
      "Parameters are set with --set NAME=VALUE (gloam list techniques).");
  command->callback([flags, command] { auto_command(*flags, *command); });
}

}  // namespace gloam::cli
