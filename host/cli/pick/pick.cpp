// gloam pick FRAME.exr --budget 20ms | --error 0.02: the setting to use
#include "choose/pick.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "base/statistics.h"
#include "base/temporary_folder.h"
#include "choose/document.h"
#include "choose/shot.h"
#include "cli/bench/sequence.h"
#include "cli/bench/subjects.h"
#include "cli/flags/budget.h"
#include "cli/flags/shot_flags.h"
#include "gloam/error.h"
#include "measure/effects.h"
#include "planner/goal.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

struct PickCommand : DeviceFlags {
  std::vector<std::string> truths;
  std::string frame, techniques;
  VariantFlags variant;
  Goal goal;
  std::optional<double> radius;
  PickBy by = PickBy::rmse;
  int rays = 256, rounds = 9;
  double time = 60;  ///< seconds
  bool all = false;
  FrameChoice choice;
  FrameFlags frame_flags;
  JsonFlag json;
  const CLI::App* app = nullptr;
};

std::vector<std::string> named_techniques(const PickCommand& flags) {
  std::vector<std::string> names;
  if (!flags.techniques.empty()) names = split_list(flags.techniques, "--techniques");
  for (std::string& name : names) name = variant_name(name, flags.variant);
  return names;
}

/// Without techniques.
PickOptions options_of(const PickCommand& flags) {
  check_has_goal(flags.goal, "pick");
  return {.goal = flags.goal, .by = flags.by, .rounds = flags.rounds, .progress = show_status};
}

std::string run_line(const PickCommand& flags, const Variation& v) {
  const bool is_shot = FramePattern::is_pattern(flags.frame);
  std::string line = fmt::format("gloam run {} {} -o {}", v.technique->name, quoted_for_shell(flags.frame),
                                 is_shot ? "'ao.####.exr'" : measured_plane(*v.technique) + ".exr");
  if (v.temporal) line += " --temporal";
  if (!v.preset.empty()) line += " --preset " + v.preset;
  std::string radius = radius_parameter(v.technique->parameters);
  if (radius.empty()) radius = radius_parameter(source_of(*v.technique).parameters);
  if (!radius.empty()) line += fmt::format(" --{} {}", radius, float(v.radius));
  if (v.resolution > 1) line += " --resolution " + v.variant;
  return line + flags.as_text() + reading_text(*flags.app);
}

/// Why it is that one, and what was not tried.
void print_why(const std::string& why, const std::string& not_tried) {
  fmt::print("{}\n", printable(why));
  if (!not_tried.empty()) fmt::print("{}\n", printable(not_tried));
}

void print(const Picked& picked, PickBy by, const DeviceInfo& device) {
  const bool has_flip = by == PickBy::flip;
  std::vector<std::vector<std::string>> rows = {{"", "technique", "preset", "resolution", "ms", "RMSE", "SSIM"}};
  if (has_flip) rows[0].push_back("FLIP");
  for (size_t i = 0; i < picked.finalists.size(); ++i) {
    const bench::Choice& c = picked.finalists[i];
    rows.push_back({i == picked.best ? ">" : "", c.variation.technique->name, c.variation.name(),
                    resolution_of(c.variation), fmt::format("{:.2f}", c.ms), fmt::format("{:.4f}", c.rmse),
                    c.ssim ? fmt::format("{:.4f}", *c.ssim) : "-"});
    if (has_flip) rows.back().push_back(fmt::format("{:.4f}", *c.flip));
  }
  print_table(rows, 4);
  fmt::print("{} of {} settings that were tried; {}; errors to {}; {} decides (--by)\n", picked.finalists.size(),
             picked.tried, printable(device.name), printable(picked.truth), name_of(by));
  print_why(picked.why, not_tried_in_words(picked.left_out, picked.skipped));
}

SceneOptions truths_in(const std::filesystem::path& folder, const PickCommand& flags) {
  SceneOptions scene;
  scene.folder = folder;
  scene.rays = flags.rays;
  scene.radius = flags.radius;
  scene.progress = show_status;
  return scene;
}

constexpr size_t most_rows = 12;

Json entry_of(const SequenceRow& row) {
  return {{"technique", row.variation.technique->name},
          {"preset", row.variation.name()},
          {"temporal", row.variation.temporal},
          {"ms", median(row.ms)},
          {"rmse", row.rmse},
          {"ssim", row.ssim},
          {"flicker", row.flicker.flicker() ? Json(*row.flicker.flicker()) : Json(nullptr)}};
}

void print(const MeasuredShot& shot, const PickOptions& options, const DeviceInfo& device) {
  std::vector<std::vector<std::string>> table = {{"", "technique", "preset", "", "ms", "RMSE", "SSIM", "flicker"}};
  const std::vector<SequenceRow>& rows = shot.measured.rows;
  for (size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
    const std::optional<double> flicker = rows[i].flicker.flicker();
    table.push_back({i == 0 ? ">" : "", rows[i].variation.technique->name, rows[i].variation.name(),
                     rows[i].variation.temporal ? "temporal" : "", fmt::format("{:.2f}", median(rows[i].ms)),
                     fmt::format("{:.4f}", rows[i].rmse), fmt::format("{:.4f}", rows[i].ssim),
                     flicker ? fmt::format("{:.4f}", *flicker) : "-"});
  }
  print_table(table, 4);
  fmt::print("{} of {} settings, over {} frames; {}; ms: kernels of one frame; {} decides (--by)\n", table.size() - 1,
             rows.size(), shot.sequence.frames.size(), printable(device.name), name_of(options.by));
}

/// Measures all presets of the techniques on the frames, each alone and over time, and prints the most accurate (or the calmest) within
/// the budget, or the cheapest within the error. Throws Error that names the nearest miss if nothing is within the bound.
void pick_shot(const PickCommand& flags, const PickOptions& options, const std::vector<Skipped>& left_out) {
  if (options.by == PickBy::flip)
    throw UsageError("--by flip: is measured on one frame; of a shot, --by takes rmse, ssim and flicker");
  const TemporaryFolder scratch("pick");
  const SceneOptions scene = truths_in(scratch.path(), flags);
  Device device = flags.open();
  const SequenceBenchFlags sequence{.sequence = flags.frame,
                                    .truths = flags.truths,
                                    .folder = scratch.path(),
                                    .choice = flags.choice,
                                    .frame_flags = flags.frame_flags,
                                    .names_techniques = !flags.techniques.empty()};
  check(sequence);
  MeasureOptions measuring;
  measuring.techniques = options.techniques;
  measuring.progress = options.progress;
  MeasuredShot shot = measure_own_shot(sequence, measuring, scene, left_out, device, {{"--json", flags.json.file()}});
  std::vector<SequenceRow>& rows = shot.measured.rows;
  const std::string why = rank(rows, options);
  const std::string command = run_line(flags, rows.front().variation);
  Json document = {{"command", command}};
  document.update(entry_of(rows.front()));
  document["why"] = why;
  document["device"] = device.info().name;
  document["by"] = word_for(options.by, pick_figures);
  document["settings"] = Json::array();
  for (const SequenceRow& row : rows) document["settings"].push_back(entry_of(row));
  document["skipped"] = Json::array();
  for (const Skipped& s : shot.measured.skipped)
    document["skipped"].push_back({{"technique", s.technique}, {"preset", s.preset}, {"why", s.why}});
  flags.json.write(document);
  if (flags.json.only_json()) return;
  print(shot, options, device.info());
  print_why(why, not_tried_in_words({}, shot.measured.skipped));
  fmt::print("{}\n", printable(command));
}

void pick_command(const PickCommand& flags) {
  std::vector<Skipped> left_out;
  const bool is_shot = FramePattern::is_pattern(flags.frame);
  const std::vector<std::string> named = named_techniques(flags);
  const std::string effect = is_shot ? "ao" : effect_to_pick(flags.truths, named);
  PickOptions options = options_of(flags);
  options.techniques = techniques_to_pick(named, effect, left_out, flags.variant);
  if (is_shot && flags.app->get_option("--time")->count() > 0)
    throw UsageError("--time: of a shot all settings are tried; leave it out, or name fewer --techniques or --frames");
  if (is_shot) return pick_shot(flags, options, left_out);
  check_no_frames(flags.choice, flags.frame);
  if (options.by == PickBy::flicker)
    throw UsageError("--by flicker: is of a shot, and {} is one frame; write its number as in shot.####.exr",
                     flags.frame);
  std::vector<NamedPath> inputs = {{"the frame", flags.frame}, {"--camera", flags.frame_flags.camera}};
  for (const std::string& truth : flags.truths) inputs.emplace_back("--truth", truth);
  check_paths(inputs, {{"--json", flags.json.file()}});
  if (!flags.all) options.limit = TimeLimit(flags.time);
  const TemporaryFolder scratch("pick");
  const SceneOptions scene = truths_in(scratch.path(), flags);
  Device device = flags.open();
  const PickedOnFrame made = pick_on_frame(own_frame(flags.frame, flags.frame_flags, flags.truths), effect, options,
                                           scene, left_out, device, note);
  const Picked& picked = made.picked;
  const RadiusReport radius = report_of(made.subject, options.techniques);
  erase_status();
  const std::string command = run_line(flags, picked.finalists[picked.best].variation);
  Json document = {{"command", command}};
  document.update(document_of(picked, flags.by, device.info()));
  radius.add_to(document);
  document["memory_bytes"] = made.subject.memory_bytes;
  if (!picked.has_truth) note({stand_in_warning(picked)});
  document["notes"] = picked.has_truth ? Json::array() : Json::array({stand_in_warning(picked)});
  flags.json.write(document);
  if (flags.json.only_json()) return;
  print(picked, options.by, device.info());
  radius.print();
  fmt::print("{}\n", command);
}

}  // namespace

void add_pick(CLI::App& app) {
  auto flags = std::make_shared<PickCommand>();
  CLI::App* command = app.add_subcommand(
      "pick", "the most accurate setting within a time on this device, or the cheapest within an error");
  flags->app = command;
  add_text(*command, "frame", flags->frame, "FRAME.exr", "EXR file")->required();
  add_frames(*command, flags->choice);
  add_missing_without_hold(*command, flags->choice);
  add_budget(*command, flags->goal, "time for the whole of the effect, its filter included: 20ms, or 60fps");
  add_number(*command, "--error", flags->goal.error, {0, 1},
             "RMSE to the truth; with --by ssim 1 - SSIM, with --by flip FLIP", "ERROR");
  add_choice(*command, "--by", flags->by, pick_figures,
             "what decides which image is nearer; default rmse; ssim minds noise and lost edges, flip what an eye "
             "sees, flicker, of a "
             "shot, what moves without reason");
  add_text(*command, "--truth", flags->truths, "REF.exr",
           "ambient occlusion, or another effect, as gloam reference makes it, of all views, or once for each "
           "view (REF_left.exr, "
           "REF_right.exr); default: traced where the frame shows a built-in scene, else a converged estimate")
      ->expected(1)
      ->take_all();
  add_text(*command, "--techniques", flags->techniques, "A,B",
           "these only; default: all that make the truth's effect of every view, without a truth ao");
  flags->variant.add_to(*command);
  add_number(*command, "--radius", flags->radius, allowed_radii,
             "scene units; default: the truth's, else the scene's own, else made from the frame", "R");
  add_number(*command, "--rays", flags->rays, allowed_rays, "per pixel, for a truth that is traced; default 256", "N");
  add_number(*command, "--rounds", flags->rounds, allowed_rounds, "each times every finalist once, in turn; default 9",
             "N");
  CLI::Option* time = add_parsed(*command, "--time", flags->time, parse_time,
                                 "how long reading the frame, trying settings, the likeliest first, and timing the "
                                 "best few in turn may take; tracing a truth comes on top; default 1m",
                                 "1m");
  command->add_flag("--all", flags->all, "try every setting, however long it takes; of a shot always")->excludes(time);
  flags->DeviceFlags::add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Tries presets at full and at half resolution on the frame, and prints the choice as a gloam run line. Left out "
      "is what a faster setting\n"
      "that is too slow already rules out, and what does not fit in the time.\n"
      "Examples:\n"
      "  gloam pick frame.exr --budget 20ms --truth ao_ref.exr\n"
      "  gloam pick frame.exr --budget 60fps --truth ao_ref.exr\n"
      "  gloam pick frame.exr --error 0.1 --truth ao_ref.exr --json -\n"
      "  gloam pick 'shot.####.exr' --truth 'truth.####.exr' --frames 1-8 --budget 20ms --by flicker");
  command->callback([flags] { pick_command(*flags); });
}

}  // namespace gloam::cli
