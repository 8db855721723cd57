// gloam bench -o DIR: the time that accuracy costs
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "base/elapsed.h"
#include "base/files.h"
#include "cli/bench/baseline.h"
#include "cli/bench/chunks.h"
#include "cli/bench/file.h"
#include "cli/bench/paper.h"
#include "cli/bench/print.h"
#include "cli/bench/request.h"
#include "cli/bench/rows.h"
#include "cli/bench/sequence.h"
#include "cli/bench/set.h"
#include "cli/flags/shot_flags.h"
#include "cli/process/chunk_commands.h"
#include "cli/report/compare.h"
#include "gloam/error.h"
#include "measure/document.h"
#include "measure/effects.h"
#include "measure/google_benchmark.h"
#include "measure/measurement.h"
#include "measure/native.h"
#include "measure/processes.h"
#include "report/comparison_page.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

/// Throws UsageError for what cannot be divided, too.
void print_chunks(const BenchCommand& flags) {
  if (!flags.json.path.empty()) throw UsageError("--json {}: each chunk would write it; leave it out", flags.json.path);
  Measurement unused;
  DeviceInfo any;
  any.has_double = true;  // the machine of each chunk says what it lacks
  const BenchOptions options = options_of(flags, any, unused);
  BenchChunks divided{
      .repeated = flags.repeated, .folder = flags.folder, .has_growth = !flags.no_growth, .chunks = flags.chunks};
  for (const SceneRecipe* scene : options.scenes) divided.scenes.push_back(scene->name);
  const bool need_each_other = !flags.presets.empty() || !flags.sweeps.empty() ||
                               std::any_of(options.techniques.begin(), options.techniques.end(),
                                           [](const Technique* t) { return !needs_naming(*t).empty(); });
  if (!flags.techniques.empty()) {
    for (const Technique* t : options.techniques) divided.techniques.push_back(t->name);
  }
  divided.divides_techniques = !flags.techniques.empty() && !need_each_other;
  if (divided.scenes.empty() && !divided.divides_techniques)
    throw UsageError(
        "--chunks {}: --frame {} is one frame, and its techniques are divided only where --techniques names "
        "them, without --presets, --sweep and techniques of two views",
        flags.chunks, flags.frame);
  print_bench_chunks(divided);
}

/// The first flag given that says how frames are read; empty if there is none.
std::string reading_flag(const CLI::App& app) {
  const std::vector<const CLI::Option*> given = reading_flags(app);
  return given.empty() ? "" : given.front()->get_name();
}

SequenceBenchFlags sequence_flags(const BenchCommand& flags) {
  return {flags.sequence,         flags.truths,
          flags.folder,           flags.choice,
          flags.frame_flags,      reading_flag(*flags.app),
          flags.size.has_value(), !flags.techniques.empty()};
}

/// Rows of an earlier result, and those of several processes, are measured whole: their figures are compared.
bool measures_all(const BenchCommand& flags) {
  return flags.all || !flags.rows.empty() || !flags.baseline.empty() || flags.processes > 1;
}

/// Measures rows of a set again; with --baseline says which are worse.
void bench_rows_of_set(const BenchCommand& flags, Device& device, const std::vector<WantedRow>& rows,
                       const report::Source& before) {
  const std::filesystem::path file = std::filesystem::path(flags.folder) / "bench.json";
  std::optional<ComparedWithBaseline> compared;
  bench_set(flags, device, {rows, [&](Json& document) {
                              if (flags.baseline.empty()) return;
                              compared = compare_with_baseline(before, file);
                              document["comparison"] =
                                  report::document_of(compared->comparison, compared->before, compared->now);
                            }});
  if (compared) tell(*compared, flags.regression, flags.json.only_json());
}

/// Flags that a further process has in its own form, or not.
const std::set<std::string>& not_of_further_processes() {
  static const std::set<std::string> flags = {
      "--output", "--json",    "--rows",      "--baseline",  "--regression", "--processes",
      "--rounds", "--effects", "--scenes",    "--presets",   "--techniques", "--variants",
      "--sweep",  "--ladder",  "--no-growth", "--no-checks", "--no-images",  "--google-benchmark"};
  return flags;
}

/// Throws UsageError for flags about frames without frames.
void check_flags(const BenchCommand& flags) {
  if (flags.sequence.empty() && flags.choice.frames) throw UsageError("--frames: is for a shot; --sequence names one");
  if (!flags.sequence.empty() && !flags.effects.empty())
    throw UsageError("--effects {}: of a shot ambient occlusion alone is measured; leave it out", flags.effects);
  if (flags.sequence.empty() && flags.frame.empty() && !flags.truths.empty())
    throw UsageError("--truth {}: whose truth it is has to be said: --frame FRAME.exr, or --sequence 'shot.####.exr'",
                     flags.truths.front());
  if (!flags.sequence.empty()) return check(sequence_flags(flags));
  const std::string reading = reading_flag(*flags.app);
  if (flags.frame.empty() && !reading.empty())
    throw UsageError("{}: says how frames are read, and there is none; --frame or --sequence names them", reading);
}

/// What is told of the subjects that were measured.
struct MeasuredSubjects {
  std::vector<std::pair<std::string, RadiusReport>> radii;
  unsigned long long memory = 0;  ///< of the user's own frame, bytes
};

/// Measures the effects on the user's own frame, else on the scenes.
MeasuredSubjects measure_subjects(const BenchCommand& flags, const BenchOptions& options, const BenchFile& written,
                                  TimeLimit& limit, Device& device, Measurement& result,
                                  const std::function<void()>& keep) {
  MeasuredSubjects measured;
  const bool is_own = !flags.frame.empty();
  const size_t frames = is_own ? 1 : options.scenes.size();
  size_t left = options.effects.size() * frames;
  for (size_t i = 0; i < frames; ++i) {
    for (const std::string& effect : options.effects) {
      MeasureOptions of_effect = for_effect(options, effect);
      const auto start = std::chrono::steady_clock::now();
      Subject subject = is_own ? own_subject(own_frame(flags.frame, flags.frame_flags, flags.truths), effect,
                                             of_effect.techniques, options.scene, note)
                               : builtin_subject(*options.scenes[i], effect, of_effect.techniques, options.scene, note);
      written.check(subject);
      if (is_own) measured.memory = std::max(measured.memory, subject.memory_bytes);
      if (!is_own) limit.extend(seconds_since(start));  // capturing and tracing are done once, and their files stay
      if (effect == options.effects.front())
        measured.radii.emplace_back(subject.name, report_of(subject, options.techniques));
      of_effect.limit = limit.part(1.0 / double(left--));
      measure(subject, of_effect, i == 0, device, result);
      if (left > 0 && !result.rows.empty()) keep();
    }
  }
  return measured;
}

/// Tells the ledger of what is read and written. `before`: an earlier result, if any.
void check_files(const BenchCommand& flags, const BenchOptions& options, const NamedPath& before) {
  std::vector<NamedPath> inputs = {{"--frame", flags.frame}, {"--camera", flags.frame_flags.camera}};
  for (const std::string& truth : flags.truths) inputs.emplace_back("--truth", truth);
  inputs.push_back(before);
  check_paths(inputs,
              {{"-o", (options.scene.folder / "scene.exr").string()},
               {"--google-benchmark", flags.google_benchmark},
               {"--json", flags.json.file()}},
              {{"-o", (std::filesystem::path(flags.folder) / "bench.json").string()}});
}

void bench_command(const BenchCommand& given) {
  check_flags(given);
  // An earlier result says what is measured.
  const std::string& earlier = given.baseline.empty() ? given.rows : given.baseline;
  std::optional<report::Source> before;
  if (!earlier.empty()) before = result_of(earlier);
  std::vector<WantedRow> rows;
  const BenchCommand flags = before ? flags_for_rows(given, *before, rows) : given;
  if (flags.chunks > 0) return print_chunks(flags);
  if (!flags.paper.empty()) {
    bench_paper({flags.paper, flags.folder, flags, flags.size, flags.rays, flags.rounds}, flags.json);
    return;
  }
  if (!make_openmp_wait_passively())
    note({"OMP_WAIT_POLICY=passive could not be set: threads of the native loop may take time from the others"});
  Measurement result;
  Device device = flags.open();
  if (!flags.set.empty() && before) {
    make_output_folder(flags.folder);
    check_paths({{earlier, before->file.string()}}, {},
                {{"-o", (std::filesystem::path(flags.folder) / "bench.json").string()}});
    return bench_rows_of_set(flags, device, rows, *before);
  }
  if (!flags.set.empty()) return bench_set(flags, device);
  BenchOptions options = options_of(flags, device.info(), result);
  options.rows = rows;
  if (!flags.sequence.empty())
    return bench_sequence(sequence_flags(flags), options, options.scene, result.skipped, device, flags.json);
  make_output_folder(options.scene.folder);
  const std::filesystem::path folder = flags.folder;
  check_files(flags, options, {earlier, before ? before->file.string() : ""});
  const BenchFile written(flags.folder);
  say_on_interruption("bench.json is as it was, and pictures and truths of this run may lie beside it; run it again");
  TimeLimit limit = measures_all(flags) ? TimeLimit() : TimeLimit(flags.time);
  options.limit = limit;
  if (limit.is_set())
    options.progress = [&limit](const std::string& what, double share) {
      show_status(fmt::format("{}, {} left", what, time_words(limit.left())), share);
    };
  // What a run is compared with is kept until all is measured.
  const auto keep = [&] {
    if (before) return;
    Json document = report::document_of(results_of(result, options, device.info()));
    document["time_limit_s"] = limit.is_set() ? Json(flags.time) : Json(nullptr);
    say_on_interruption(
        "bench.json is whole, as it was or with the scenes that were measured; the same command measures all of them "
        "again");
    written.write(document);
    say_on_interruption("bench.json holds the scenes that were measured; the same command measures all of them again");
  };
  const MeasuredSubjects measured = measure_subjects(flags, options, written, limit, device, result, keep);
  erase_status();
  note(result.notes);
  if (result.rows.empty() && !result.left_out.empty())
    throw Error("--time {}: nothing could be measured in that time on this device; a longer one, or --all, measures",
                time_words(flags.time));
  if (result.rows.empty())
    throw Error("nothing could be measured: {} {}", result.skipped.back().technique, result.skipped.back().why);
  report::Measurements results = results_of(result, options, device.info());
  const auto document_of_all = [&](int processes) {
    Json document = report::document_of(results);
    if (measured.memory > 0) document["memory_bytes"] = measured.memory;
    document["time_limit_s"] = limit.is_set() ? Json(flags.time) : Json(nullptr);
    if (processes > 1) document["processes"] = processes;
    return document;
  };
  const std::filesystem::path file = written.path();
  Json document = document_of_all(1);
  written.write(document);
  if (flags.processes > 1) {
    measure_in_more_processes({flags.processes, flags.repeated, folder, flags.rounds, show_status}, results);
    erase_status();
    written.write(document = document_of_all(flags.processes));
  }
  if (!flags.google_benchmark.empty()) JsonFlag{flags.google_benchmark}.write(google_benchmark_of(document));
  std::optional<ComparedWithBaseline> compared;
  if (!flags.baseline.empty()) {
    compared = compare_with_baseline(*before, file);
    document["comparison"] = report::document_of(compared->comparison, compared->before, compared->now);
  }
  flags.json.write(document);
  if (compared) return tell(*compared, flags.regression, flags.json.only_json());
  if (flags.json.only_json()) return;
  if (before) return fmt::print("wrote {}\n", printable(file.string()));
  print(result, options, device.info());
  for (const auto& [name, radius] : measured.radii) fmt::print("{}: {}\n", printable(name), radius.words());
  fmt::print("wrote {}\n", printable((folder / "bench.json").string()));
}

/// What is measured on.
void add_subject_flags(CLI::App& command, BenchCommand& flags) {
  CLI::Option* scenes = add_text(command, "--scenes", flags.scenes, "A,B",
                                 "built-in scenes, or all; default: " + enumerate(default_scenes));
  CLI::Option* frame =
      add_text(command, "--frame", flags.frame, "FRAME.exr", "measure on this frame instead of scenes");
  add_text(command, "--truth", flags.truths, "REF.exr",
           "the frame's truth, as gloam reference makes it, once for each effect, of all views, or once for each "
           "view (REF_left.exr, REF_right.exr); default: traced where the frame shows a built-in scene")
      ->expected(1)
      ->take_all();
  add_text(command, "--sequence", flags.sequence, "SHOT|FRAME.####.exr",
           "measure on a shot instead, with flicker and over time: one of gloam list shots, or a pattern");
  add_text(command, "--set", flags.set, "DIR",
           "measure on the items of a set instead, as gloam set make makes it, beside methods that gloam score adds");
  add_text(command, "--items", flags.items, "A,B", "with --set: these items only")->needs("--set");
  add_frames(command, flags.choice);
  add_missing_without_hold(command, flags.choice);
  command.get_option("--frames")->description("with --sequence: 1001-1100, 1-99x2 or 1,5,9-12; default: the first 10");
  CLI::Option* size =
      add_parsed(command, "--size", flags.size, parse_size,
                 "of the scenes' images; default 960x540, with --paper 1920x1080, with --sequence 640x360", "WxH");
  frame->excludes(scenes)->excludes(size);
}

/// How much is measured, and how often.
void add_extent_flags(CLI::App& command, BenchCommand& flags) {
  add_choice(
      command, "--ladder", flags.ladder,
      {{"none", LadderFor::none}, {"presets", LadderFor::presets}, {"all", LadderFor::all}},
      "measure also the steps from a setting to the truth (the error ladder), which tell how much of the error is "
      "of few samples, of noise, of hidden surfaces, of the filter; of each preset (presets, the default), of "
      "variants too (all), or not (none)");
  add_number(command, "--rounds", flags.rounds, allowed_rounds,
             "each runs everything once, in turn; default 9 with --all, else 6 to 30: until the ratio of each setting "
             "is known to 2 %",
             "N");
  CLI::Option* time = add_parsed(command, "--time", flags.time, parse_time,
                                 "how long measuring may take, the front first, then the rest as time allows; what was "
                                 "left out is said; capturing and "
                                 "tracing built-in scenes does not count; default 1m",
                                 "1m");
  command.add_flag("--all", flags.all, "measure everything, however long it takes; of a shot and of --set always")
      ->excludes(time);
  command.add_flag("--no-growth", flags.no_growth, "leave out how times grow with pixels, samples, radius ...");
  command.add_flag("--no-checks", flags.no_checks,
                   "leave out what changes with the resolution and what bare planes read");
  command.add_flag("--no-images", flags.no_images, "leave out the pictures in DIR/images");
}

}  // namespace

void add_bench(CLI::App& app) {
  auto flags = std::make_shared<BenchCommand>();
  CLI::App* command =
      app.add_subcommand("bench", "what accuracy costs in time: times, ratios and errors of techniques");
  add_text(*command, "-o,--output", flags->folder, "DIR",
           "folder for bench.json, images/ and scenes/; made where it is not there")
      ->required();
  add_text(*command, "--effects", flags->effects, "A,B",
           "planes that are measured: " + enumerate(effect_names()) +
               ", or all; default: those that --truth holds, or that --techniques make, else ao");
  add_text(*command, "--techniques", flags->techniques, "A,B",
           "these only; default: all that make the effects of every view");
  flags->variant.add_to(*command);
  add_text(*command, "--presets", flags->presets, "A,B", "these only; default: all that a technique has");
  add_subject_flags(*command, *flags);
  add_number(*command, "--rays", flags->rays, allowed_rays,
             "per pixel, for truths that are traced; default 256, with --paper what the paper's figures need", "N");
  add_number(*command, "--radius", flags->radius, allowed_radii,
             "scene units; default: the truth's, else the scene's own, else made from the frame", "R");
  add_text(*command, "--variants", flags->variants, "A,B",
           fmt::format("of one preset (medium, else the first): none, all or some of {}; default: {}",
                       enumerate(variant_names()), enumerate(default_variants())));
  add_text(*command, "--sweep", flags->sweeps, "NAME=V1,V2",
           "values of a parameter to measure in turn, as variants of the same preset, for techniques that have "
           "it (repeatable: every combination)")
      ->expected(1)
      ->take_all();
  add_extent_flags(*command, *flags);
  flags->DeviceFlags::add_to(*command);
  CLI::Option* paper =
      add_text(*command, "--paper", flags->paper, "NAME",
               "measure the tables and figures of a paper again, instead: " + enumerate(paper_names()));
  add_text(*command, "--google-benchmark", flags->google_benchmark, "FILE.json",
           "also write the result in Google Benchmark's form, for tools that read it")
      ->group("Writing");
  add_chunk_flags(*command, flags->chunks, flags->print, "the scenes, and named techniques,", "Several machines");
  flags->frame_flags.add_to(*command);
  add_rows_flags(*command, *flags);
  const std::vector<std::string> shared = {"--output",    "--size", "--rounds",   "--rays", "--device",
                                           "--no-tuning", "--help", "--help-all", "--paper"};
  for (CLI::Option* option : command->get_options()) {
    if (!contains(shared, option->get_name())) option->excludes(paper);
  }
  for (const char* option : {"--scenes", "--frame", "--variants", "--sweep", "--ladder", "--rounds", "--no-growth",
                             "--no-checks", "--no-images", "--chunks", "--time", "--google-benchmark"})
    command->get_option("--sequence")->excludes(command->get_option(option));
  flags->app = command;
  flags->json.add_to(*command);
  command->footer(
      "Frames and truths stay in DIR/scenes and are used again. Examples:\n"
      "  gloam bench -o out/bench                       what fits in a minute\n"
      "  gloam bench -o out/bench --all                 everything\n"
      "  gloam bench -o out/bench --techniques hbao+ --scenes all --size 1920x1080\n"
      "  gloam bench -o out/layers --techniques gtao,hbao+ --layers stochastic\n"
      "  gloam bench -o out/steps --techniques gtao --presets medium --sweep steps=4,9,18 --sweep directions=1,2,4\n"
      "  gloam bench -o 'out/bench.##' --scenes all --chunks 7 --print | parallel\n"
      "  gloam bench -o out/shi2022 --paper shi2022\n"
      "  gloam bench -o out/odssao2020 --paper odssao2020\n"
      "  gloam bench -o out/walk --sequence gallery:walk --techniques hbao+,gtao\n"
      "  gloam bench -o out/mine --frame frame.exr --truth ao_ref.exr --presets low,medium\n"
      "  gloam bench -o out/before --techniques hbao+,gtao,ssao,hbao --processes 4\n"
      "  gloam bench -o out/after --baseline out/before/bench.json\n"
      "  gloam bench -o out/light --effects indirect,bounces,specular_occlusion,contact --scenes all");
  command->callback([flags, command] {
    flags->repeated = repeated_words(*command, flags->chunks > 0 ? not_of_bench_chunks() : not_of_further_processes());
    // Other machines have no one who waits.
    if (flags->chunks > 0 && !flags->all && command->get_option("--time")->count() == 0)
      flags->repeated.push_back("--all");
    bench_command(*flags);
  });
}

}  // namespace gloam::cli
