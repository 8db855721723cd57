// gloam auto FRAME.exr -o OUT.exr
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "auto/mask_words.h"
#include "cli/auto/command.h"
#include "cli/flags/budget.h"
#include "cli/flags/given_flags.h"
#include "cli/flags/memory.h"
#include "cli/flags/radius.h"
#include "cli/flags/result_name.h"
#include "cli/shot/shot.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/visualise.h"
#include "shot/auto_step.h"
#include "shot/outputs.h"

namespace gloam::cli {
namespace {

void run_on_one_frame(const AutoCommand& flags) {
  RunOptions options = flags.run_flags.run_options();
  // Times to compare must not include what a device does only once.
  if (flags.measure) options.repeat = std::max(options.repeat, 3);
  const WriteOptions writing{!flags.shot.as_float, flags.compression, {}, true, flags.shot.keep_margin};
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  check_paths(inputs, {{"-o", flags.out},
                       {"--composite", flags.composite.path},
                       {"--explain", flags.explain},
                       {"--json", flags.json.file()}});
  const bool explains = !flags.explain.empty();
  FrameFiles files = flags.frame.open(flags.frame_flags.read_options());
  check_pictures({"--explain", flags.explain}, files.views());
  std::vector<std::string> notes_on_light;
  const AutoPurpose purpose{explains, flags.goal || !flags.composite.path.empty(),
                            compose_options(flags.composite.light, files, notes_on_light)};
  PlanRequest asked = flags.technique_flags.request({});
  asked.only_filtered = true;
  AutoFrame planned = planned_auto(std::move(files), asked, purpose);
  check_goal(flags.goal, planned);
  check_has_depth(planned, flags.out);
  std::optional<CompositeSource> source =
      open_composite(flags.composite.asked(), flags.frame.files(), flags.frame_flags.read_options());
  const unsigned long long memory = planned_memory(
      flags.frame_flags, planned.files.name(), flags.run_flags.device,
      [&](bool shares_memory) { return bytes_of_auto(planned, shares_memory) + bytes_of(source); },
      "crop or shrink the frame, ask for --resolution half, or for one view (--view)");
  Device device = flags.run_flags.open();
  Frame frame = read_and_judge(planned, asked, purpose);
  note(frame.assumed);
  note(notes_on_margin(frame, flags.shot.keep_margin, flags.shot.keep_margin));
  check_goal(flags.goal, planned);
  leave_out(source, planned.unfit);
  if (flags.goal && !source) note(notes_on_light);
  const Radius made = default_radius(frame, stated_radius(planned.files));
  set_radius(planned, made.value);
  options.progress = progress_bar();
  const AutoSettings settings{.mask = flags.mask.value_or(MaskUse::measured),
                              .measures = flags.measure,
                              .purpose = purpose,
                              .radius_from = made.from,
                              .goal = flags.goal,
                              .measuring = progress_bar()};
  AutoResult result = compute_effects(planned, settings, frame, device, options);
  std::optional<RadiusReport> radius;
  if (result.used_radius) radius.emplace(*result.used_radius, frame, result.radius_cap);
  std::vector<std::string> written;
  if (!flags.out.empty()) written.push_back(flags.out);
  if (explains) {
    for (const View& view : frame.views) {
      written.push_back(picture_path(flags.explain, view.name, frame.views.size() > 1).string());
      write_explanation(written.back(), view, explanations_of(result, view.name),
                        {.title = planned.files.name(),
                         .sentence = sentence_on(result),
                         .totals = totals_in_words(result, flags.goal),
                         .picture = result.picture ? result.picture->view(view.name).find("color") : nullptr});
    }
  }
  std::optional<Composition> composition;
  if (source) {
    read_colour(*source);
    const Composite composite = make_composite(*source, result.frame);
    composition = composite.composition;
    note(composition->notes);
    write_composite(flags.composite.path, composite, writing);
    written.push_back(flags.composite.path);
  }
  if (!flags.out.empty()) {
    // Where nothing is called for, a frame with a plane is written all the same.
    const bool keeps_depth = flags.shot.keep_depth || result.frame.views.front().planes.empty();
    for (View& view : result.frame.views)
      if (keeps_depth) view.planes["depth"] = std::move(frame.view(view.name).planes.at("depth"));
    if (flags.frame.other_eye.empty() && !flags.frame_flags.changes_depth())
      name_frame(result.frame, flags.frame.frame, flags.out);
    if (flags.is_out_made) result.frame.attributes[named_by_gloam] = frame_seen_from(flags.frame.frame, flags.out);
    write_frame(flags.out, result.frame, writing);
  }
  if (const std::string missed = note_on_goal(result, flags.goal); !missed.empty()) note({missed});
  Json document = document_of(result, flags.goal, device.info());
  document["memory_bytes"] = memory;
  if (composition) {
    document["composite"] = composition_document(*composition);
    document["not_darkened"] = composition->untouched;
  }
  if (radius) radius->add_to(document);
  flags.json.write(document, written);
  if (flags.json.only_json()) return;
  print(result, flags.goal);
  if (radius) radius->print();
  if (composition) fmt::print("{}\n", composition_in_words(*composition));
  print_written(written);
}

/// A picture in place of the frame to write is that of --explain; where nothing is named, the result lies beside the frame.
void settle_files(AutoCommand& flags) {
  if (std::filesystem::path(flags.out).extension() == ".png" && !flags.frame.has_pattern()) {
    if (!flags.explain.empty())
      throw UsageError("-o {}: is a picture, and --explain {} another; leave one out", flags.out, flags.explain);
    flags.explain.swap(flags.out);
  }
  if (!flags.out.empty() || !flags.composite.path.empty() || !flags.explain.empty()) return;
  flags.out = name_beside(flags.frame, "auto", "auto");
  flags.is_out_made = true;
}

/// Throws UsageError for a flag that has no effect on any of the files.
void check_files_written(const AutoCommand& flags) {
  if (!flags.out.empty()) return check_frame_name(flags.out, "-o");
  for (const auto& [flag, is_given] : {std::pair("--half", flags.half), std::pair("--float", flags.shot.as_float),
                                       std::pair("--keep-depth", flags.shot.keep_depth)}) {
    if (is_given) throw UsageError("{}: changes the file of -o OUT.exr, which is not given; leave it out", flag);
  }
}

void auto_command(const AutoCommand& given, const CLI::App& command) {
  AutoCommand flags = given;
  settle_files(flags);
  check_files_written(flags);
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
  add_text(
      *command, "-o,--output", flags->out, "OUT.exr",
      "EXR file to write, with the planes of all effects, or the picture of --explain, OUT.png; default: beside the "
      "frame, frame_auto.exr");
  add_text(*command, "--explain", flags->explain, "OUT.png", "picture of what is called for where, and why");
  add_choice(
      *command, "--mask", flags->mask, mask_words,
      "whether an effect is computed only on the tiles that call for it (the mask), or everywhere; measured (the "
      "default): both ways are timed, 3 rounds in turn, and the mask is used where it saves 5 % or more; always and "
      "never time nothing; of a shot: never");
  command->add_flag("--measure", flags->measure,
                    "also compute everything everywhere, and tell what that takes; 3 timed runs at least");
  CLI::Option* budget = add_budget(*command, flags->goal,
                                   "device time for all effects and for looking, 30ms or 60fps: effects, presets and "
                                   "resolutions are chosen for the least error of the picture");
  add_number(*command, "--error", flags->goal.error, {1e-9, 1e9},
             "RMS error of the picture (--composite): effects, presets and resolutions are chosen for the least time")
      ->excludes(budget);
  CLI::Option* half = command->add_flag("--half", flags->half, "write results as half, as is done without this flag");
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
      "  gloam auto frame.exr\n"
      "  gloam auto frame.exr -o out.exr\n"
      "  gloam auto frame.exr -o out.exr --explain why.png --measure --repeat 9\n"
      "  gloam auto frame.exr -o out.exr --budget 30ms\n"
      "  gloam auto 'shot.####.exr' -o 'out.####.exr' --budget 60fps\n"
      "  gloam auto frame.exr --composite picture.exr\n"
      "  gloam auto 'shot.####.exr' -o 'out.####.exr' --frames 1-48 --radius 0.5\n"
      "Parameters are set with --set NAME=VALUE (gloam list techniques).");
  command->callback([flags, command] { auto_command(*flags, *command); });
}

}  // namespace gloam::cli
