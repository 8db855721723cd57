// gloam bench -o DIR: the time that accuracy costs
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/document.h"
#include "bench/measurement.h"
#include "bench/native.h"
#include "bench/tables.h"
#include "cli/bench_chunks.h"
#include "cli/bench_paper.h"
#include "cli/bench_sequence.h"
#include "cli/chunk_commands.h"
#include "cli/shot_flags.h"
#include "cli/subjects.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

const std::vector<std::string> default_scenes = {"courtyard", "corridor", "colonnade", "gallery"};
constexpr int peeled_layers = 8;
constexpr size_t most_swept = 1000;

struct BenchCommand {
  std::vector<std::string> truths;
  std::string paper, folder, techniques, scenes, presets, frame, sequence, device, variants;
  std::vector<std::string> sweeps;
  std::optional<Size> size;
  std::optional<int> rays;
  std::optional<double> radius;
  int rounds = 9;
  LadderFor ladder = LadderFor::presets;
  bool no_growth = false, no_checks = false, no_images = false, print = false;
  int chunks = 0;                     ///< 0: not divided
  std::vector<std::string> repeated;  ///< words for a chunk
  FrameChoice choice;
  FrameFlags frame_flags;
  JsonFlag json;
  const CLI::App* app = nullptr;
};

constexpr Size sequence_size = {640, 360};

/// The request, checked.
struct Options : MeasureOptions {
  std::vector<const SceneRecipe*> scenes;
  SceneOptions scene;
};

// --- The request

void choose_techniques(Options& options, const std::string& list, Measurement& result) {
  for (const Technique& t : registry()) {
    if (!list.empty()) continue;
    const std::string why = no_ao(t).empty() ? needs_naming(t) : no_ao(t);
    if (why.empty())
      options.techniques.push_back(&t);
    else
      result.skipped.push_back({t.name, "", "", why});
  }
  // A truth that several techniques share has the name of the one over a single layer.
  std::stable_partition(options.techniques.begin(), options.techniques.end(),
                        [](const Technique* t) { return !reads_layers(*t); });
  if (list.empty()) return;
  for (const std::string& name : split_list(list, "--techniques")) {
    const Technique& t = find_technique(name);
    if (const std::string why = no_ao(t); !why.empty())
      throw UsageError("--techniques {}: {}; {} can be measured", name, why, enumerate(techniques_with_ao()));
    if (std::find(options.techniques.begin(), options.techniques.end(), &t) == options.techniques.end())
      options.techniques.push_back(&t);
  }
}

void choose_presets(Options& options, const std::string& list) {
  if (list.empty()) return;
  std::vector<std::string> known;
  for (const Technique* t : options.techniques) {
    for (const Preset& preset : t->presets) add_new(known, preset.name);
  }
  for (const std::string& name : split_list(list, "--presets")) {
    if (!contains(known, name))
      throw UsageError("--presets {} is not allowed{}; {} are", name, suggestion(name, known),
                       known.empty() ? "none" : enumerate(known));
    add_new(options.presets, name);
  }
}

void choose_scenes(Options& options, const std::string& list) {
  std::vector<std::string> known, chosen;
  for (const SceneRecipe& recipe : builtin_scenes()) known.push_back(recipe.name);
  if (list.empty()) {
    for (const std::string& name : default_scenes) {
      if (contains(known, name)) chosen.push_back(name);
    }
  } else if (list != "all") {
    for (const std::string& name : split_list(list, "--scenes")) {
      if (!contains(known, name))
        throw UsageError("--scenes: no built-in scene '{}'{}; there are {} and all", name, suggestion(name, known),
                         enumerate(known));
      add_new(chosen, name);
    }
  }
  for (const std::string& name : chosen.empty() ? known : chosen) options.scenes.push_back(find_builtin_scene(name));
}

void choose_variants(Options& options, const std::string& list, const DeviceInfo& device) {
  if (list == "none") return;
  options.variants = list.empty() ? default_variants() : variant_names();
  if (list.empty() || list == "all") {
    if (!device.has_double) std::erase(options.variants, "double");
    return;
  }
  options.variants.clear();
  for (const std::string& name : split_list(list, "--variants")) {
    if (!contains(variant_names(), name))
      throw UsageError("--variants {} is not allowed{}; {} are, all and none", name, suggestion(name, variant_names()),
                       enumerate(variant_names()));
    if (name == "double" && !device.has_double)
      throw UsageError("--variants double: {} has no double precision; leave it out, or use another --device",
                       device.name);
    add_new(options.variants, name);
  }
}

/// Throws UsageError for a value that no technique with the parameter accepts; techniques that do not accept it skip it.
void check_sweep(const Options& options, const Sweep& sweep, const std::vector<const Technique*>& swept,
                 Measurement& result) {
  for (const std::string& value : sweep.values) {
    std::vector<Skipped> refused;
    for (const Technique* t : swept) {
      const std::string why = not_allowed(*t, sweep.parameter, value);
      const std::vector<std::string> presets = presets_of(*t, options);
      if (!why.empty()) refused.push_back({t->name, base_preset(presets), "", why});
    }
    if (refused.size() == swept.size()) throw UsageError("--sweep: {}", refused.front().why);
    for (Skipped& skipped : refused) result.skipped.push_back(std::move(skipped));
  }
}

void choose_sweeps(Options& options, const std::vector<std::string>& items, Measurement& result) {
  std::vector<std::string> known;
  for (const Technique* t : options.techniques) {
    for (const Parameter& p : t->parameters) add_new(known, p.name);
  }
  size_t product = 1;
  for (const auto& [name, list] : parse_settings(items, "--sweep")) {
    if (!contains(known, name))
      throw UsageError("--sweep {}: no measured technique has this parameter{}; there are {}", name,
                       suggestion(name, known), enumerate(known));
    Sweep sweep{name, {}};
    for (const std::string& value : split_list(list, "--sweep " + name)) add_new(sweep.values, value);
    product *= sweep.values.size();
    options.sweeps.push_back(std::move(sweep));
  }
  if (product > most_swept)
    throw UsageError("--sweep: {} combinations; {} at most are measured, leave out values", product, most_swept);
  std::vector<const Technique*> swept;
  for (const Technique* t : options.techniques) {
    if (has_all(*t, options.sweeps)) swept.push_back(t);
  }
  if (swept.empty()) throw UsageError("--sweep: no technique that is measured has all parameters that are swept");
  for (const Sweep& sweep : options.sweeps) check_sweep(options, sweep, swept, result);
}

/// Chooses the techniques asked for; else those over one depth layer, since several layers take several times as long.
void choose_growth(Options& options, const BenchCommand& flags) {
  if (flags.no_growth) return;
  for (const Technique* t : options.techniques) {
    if (!flags.techniques.empty() || !reads_layers(*t)) options.growth.push_back(t);
  }
}

Options options_of(const BenchCommand& flags, const DeviceInfo& device, Measurement& result) {
  Options options;
  choose_techniques(options, flags.techniques, result);
  choose_presets(options, flags.presets);
  choose_variants(options, flags.variants, device);
  if (!flags.sweeps.empty()) choose_sweeps(options, flags.sweeps, result);
  choose_growth(options, flags);
  options.checks = !flags.no_checks;
  options.layers_in_full = !flags.techniques.empty();
  if (flags.frame.empty()) choose_scenes(options, flags.scenes);
  const std::optional<Size> size = flags.sequence.empty() ? flags.size : flags.size.value_or(sequence_size);
  if (size) std::tie(options.scene.width, options.scene.height) = *size;
  options.scene.layers = peeled_layers;
  options.scene.rays = flags.rays.value_or(options.scene.rays);
  options.scene.radius = flags.radius;
  options.scene.folder = std::filesystem::path(flags.folder) / "scenes";
  options.scene.progress = options.progress = show_status;
  options.rounds = flags.rounds;
  options.ladder = flags.ladder;
  if (!flags.no_images) options.folder = flags.folder;
  return options;
}

// --- Output

void print(const Table& table) {
  fmt::print("\n{}\n", printable(table.title));
  print_table(table.rows, table.first_number);
  for (const std::string& line : table.below) fmt::print("{}\n", printable(line));
}

/// Techniques with only one preset measured.
std::vector<std::string> measured_in_short(const Measurement& result, const Options& options) {
  std::vector<std::string> names;
  for (const auto& row : result.rows) {
    if (in_short(*row->variation.technique, options)) add_new(names, row->variation.technique->name);
  }
  return names;
}

/// Measured techniques whose growth was not measured.
std::vector<std::string> without_growth(const Measurement& result, const Options& options) {
  std::vector<std::string> names;
  for (const auto& row : result.rows) {
    const Technique* t = row->variation.technique;
    if (std::find(options.growth.begin(), options.growth.end(), t) == options.growth.end()) add_new(names, t->name);
  }
  return names;
}

void print(const Measurement& result, const Options& options, const DeviceInfo& device) {
  fmt::print("{}, {} ({}); {} rounds\n", cpu_model(), device.name, device.platform, options.rounds);
  fmt::print(
      "ms: the whole plan. /hbao+, /floor: over HBAO+ medium, over its own gathers alone. RMSE and bias to the truth.\n"
      "t0w to t5: RMSE of each step to the one before (docs/benchmarking.md). *: no other is as fast\nand as close, "
      "and better in one of the two.\n");
  for (const SceneFacts& scene : result.scenes) {
    print(table_of_scene(result, scene.name));
    if (const Table table = table_of_baselines(result, scene.name); table.rows.size() > 1 || !table.below.empty())
      print(table);
  }
  if (const std::vector<std::string> names = measured_in_short(result, options); !names.empty())
    fmt::print("\nof {} one preset: --techniques measures those that it names in full\n", enumerate(names));
  if (!result.growth.empty()) {
    print(table_of_growth(result));
    const std::vector<std::string> others = without_growth(result, options);
    if (!others.empty())
      fmt::print("not of {}: --techniques measures the growth of those that it names\n", enumerate(others));
  }
  for (const Skipped& s : result.skipped) {
    const std::string preset = s.preset.empty() ? "" : " " + s.preset, where = s.scene.empty() ? "" : " on " + s.scene;
    fmt::print("skipped {}{}{}: {}\n", s.technique, preset, printable(where), printable(s.why));
  }
}

/// Throws UsageError for what cannot be divided, too.
void print_chunks(const BenchCommand& flags) {
  if (!flags.json.path.empty()) throw UsageError("--json {}: each chunk would write it; leave it out", flags.json.path);
  Measurement unused;
  DeviceInfo any;
  any.has_double = true;  // the machine of each chunk says what it lacks
  const Options options = options_of(flags, any, unused);
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
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() == "Reading the frame" && option->count() > 0) return option->get_name();
  }
  return "";
}

SequenceBenchFlags sequence_flags(const BenchCommand& flags) {
  return {flags.sequence,         flags.truths,
          flags.folder,           flags.choice,
          flags.frame_flags,      reading_flag(*flags.app),
          flags.size.has_value(), !flags.techniques.empty()};
}

/// Throws UsageError for flags about frames without frames.
void check_flags(const BenchCommand& flags) {
  if (flags.sequence.empty() && flags.choice.frames) throw UsageError("--frames: is for a shot; --sequence names one");
  if (flags.sequence.empty() && flags.frame.empty() && !flags.truths.empty())
    throw UsageError("--truth {}: whose truth it is has to be said: --frame FRAME.exr, or --sequence 'shot.####.exr'",
                     flags.truths.front());
  if (!flags.sequence.empty()) return check(sequence_flags(flags));
  const std::string reading = reading_flag(*flags.app);
  if (flags.frame.empty() && !reading.empty())
    throw UsageError("{}: says how frames are read, and there is none; --frame or --sequence names them", reading);
}

void bench_command(const BenchCommand& flags) {
  check_flags(flags);
  if (flags.chunks > 0) return print_chunks(flags);
  if (!flags.paper.empty()) {
    bench_paper({flags.paper, flags.folder, flags.device, flags.size, flags.rays, flags.rounds}, flags.json);
    return;
  }
  if (!make_openmp_wait_passively())
    note({"OMP_WAIT_POLICY=passive could not be set: threads of the native loop may take time from the others"});
  Measurement result;
  Device device(flags.device);
  const Options options = options_of(flags, device.info(), result);
  if (!flags.sequence.empty())
    return bench_sequence(sequence_flags(flags), options, options.scene, result.skipped, device, flags.json);
  make_output_folder(options.scene.folder);
  const std::filesystem::path folder = flags.folder;
  std::vector<NamedPath> inputs = {{"--frame", flags.frame}, {"--camera", flags.frame_flags.camera}};
  for (const std::string& truth : flags.truths) inputs.emplace_back("--truth", truth);
  check_paths(inputs, {{"-o", (folder / "bench.json").string()},
                       {"-o", (options.scene.folder / "scene.exr").string()},
                       {"--json", flags.json.file()}});
  std::vector<std::pair<std::string, RadiusReport>> radii;
  unsigned long long memory = 0;
  if (!flags.frame.empty()) {
    Subject subject = own_subject(flags.frame, flags.frame_flags, flags.truths, options.techniques, options.scene);
    memory = subject.memory_bytes;
    radii.emplace_back(subject.name, report_of(subject, options.techniques));
    measure(subject, options, true, device, result);
  }
  for (size_t i = 0; i < options.scenes.size(); ++i) {
    Subject subject = builtin_subject(*options.scenes[i], options.techniques, options.scene);
    radii.emplace_back(subject.name, report_of(subject, options.techniques));
    measure(subject, options, i == 0, device, result);
  }
  erase_status();
  note(result.notes);
  if (result.rows.empty())
    throw Error("nothing could be measured: {} {}", result.skipped.back().technique, result.skipped.back().why);
  Json document = document_of(result, options, device.info());
  if (memory > 0) document["memory_bytes"] = memory;
  JsonFlag{(folder / "bench.json").string()}.write(document);
  flags.json.write(document);
  if (flags.json.only_json()) return;
  print(result, options, device.info());
  for (const auto& [name, radius] : radii) fmt::print("{}: {}\n", printable(name), radius.words());
  fmt::print("wrote {}\n", printable((folder / "bench.json").string()));
}

}  // namespace

void add_bench(CLI::App& app) {
  auto flags = std::make_shared<BenchCommand>();
  CLI::App* command =
      app.add_subcommand("bench", "what accuracy costs in time: times, ratios and errors of techniques");
  command
      ->add_option("-o,--output", flags->folder,
                   "folder for bench.json, images/ and scenes/; made where it is not there")
      ->required()
      ->type_name("DIR");
  command->add_option("--techniques", flags->techniques, "these only; default: all that make ao of every view")
      ->type_name("A,B");
  command->add_option("--presets", flags->presets, "these only; default: all that a technique has")->type_name("A,B");
  CLI::Option* scenes =
      command->add_option("--scenes", flags->scenes, "built-in scenes, or all; default: " + enumerate(default_scenes))
          ->type_name("A,B");
  CLI::Option* frame =
      command->add_option("--frame", flags->frame, "measure on this frame instead of scenes")->type_name("FRAME.exr");
  command
      ->add_option("--truth", flags->truths,
                   "the frame's truth, as gloam reference makes it, of all views, or once for each view (REF_left.exr, "
                   "REF_right.exr); default: traced where the frame shows a built-in scene")
      ->expected(1)
      ->take_all()
      ->type_name("REF.exr");
  CLI::Option* sequence =
      command
          ->add_option("--sequence", flags->sequence,
                       "measure on a shot instead, with flicker and over time: one of gloam list shots, or a pattern")
          ->type_name("SHOT|FRAME.####.exr");
  add_frames(*command, flags->choice);
  add_missing_without_hold(*command, flags->choice);
  command->get_option("--frames")->description("with --sequence: 1001-1100, 1-99x2 or 1,5,9-12; default: the first 10");
  CLI::Option* size =
      add_parsed(*command, "--size", flags->size, parse_size,
                 "of the scenes' images; default 960x540, with --paper 1920x1080, with --sequence 640x360")
          ->type_name("WxH");
  frame->excludes(scenes)->excludes(size);
  add_number(*command, "--rays", flags->rays, allowed_rays,
             "per pixel, for truths that are traced; default 256, with --paper what the paper's figures need")
      ->type_name("N");
  add_number(*command, "--radius", flags->radius, allowed_radii,
             "scene units; default: the truth's, else the scene's own, else made from the frame")
      ->type_name("R");
  command
      ->add_option("--variants", flags->variants,
                   fmt::format("of one preset (medium, else the first): none, all or some of {}; default: {}",
                               enumerate(variant_names()), enumerate(default_variants())))
      ->type_name("A,B");
  command
      ->add_option("--sweep", flags->sweeps,
                   "values of a parameter to measure in turn, as variants of the same preset, for techniques that have "
                   "it (repeatable: every combination)")
      ->type_name("NAME=V1,V2")
      ->expected(1)
      ->take_all();
  add_choice(*command, "--ladder", flags->ladder,
             {{"none", LadderFor::none}, {"presets", LadderFor::presets}, {"all", LadderFor::all}},
             "where errors come from, step by step; all: of variants too; default presets");
  add_number(*command, "--rounds", flags->rounds, allowed_rounds, "each runs everything once, in turn; default 9")
      ->type_name("N");
  command->add_flag("--no-growth", flags->no_growth, "leave out how times grow with pixels, samples, radius ...");
  command->add_flag("--no-checks", flags->no_checks,
                    "leave out what changes with the resolution and what bare planes read");
  command->add_flag("--no-images", flags->no_images, "leave out the pictures in DIR/images");
  command->add_option("--device", flags->device, "part of a device's or platform's name (gloam list devices)")
      ->type_name("TEXT");
  CLI::Option* paper =
      command
          ->add_option("--paper", flags->paper,
                       "measure the tables and figures of a paper again, instead: " + enumerate(paper_names()))
          ->type_name("NAME");
  add_chunk_flags(*command, flags->chunks, flags->print, "the scenes, and named techniques,", "Several machines");
  flags->frame_flags.add_to(*command);
  const std::vector<std::string> shared = {"--output", "--size", "--rounds", "--rays", "--device", "--help", "--paper"};
  for (CLI::Option* option : command->get_options()) {
    if (!contains(shared, option->get_name())) option->excludes(paper);
  }
  for (const char* option : {"--scenes", "--frame", "--variants", "--sweep", "--ladder", "--rounds", "--no-growth",
                             "--no-checks", "--no-images", "--chunks"})
    sequence->excludes(command->get_option(option));
  flags->app = command;
  flags->json.add_to(*command);
  command->footer(
      "Frames and truths stay in DIR/scenes and are used again. Examples:\n"
      "  gloam bench -o out/bench\n"
      "  gloam bench -o out/bench --techniques hbao+ --scenes all --size 1920x1080\n"
      "  gloam bench -o out/steps --techniques gtao --presets medium --sweep steps=4,9,18 --sweep directions=1,2,4\n"
      "  gloam bench -o 'out/bench.##' --scenes all --chunks 7 --print | parallel\n"
      "  gloam bench -o out/shi2022 --paper shi2022\n"
      "  gloam bench -o out/odssao2020 --paper odssao2020\n"
      "  gloam bench -o out/walk --sequence gallery:walk --techniques hbao+,gtao\n"
      "  gloam bench -o out/mine --frame frame.exr --truth ao_ref.exr --presets low,medium");
  command->callback([flags, command] {
    if (flags->chunks > 0) flags->repeated = repeated_words(*command, not_of_bench_chunks());
    bench_command(*flags);
  });
}

}  // namespace gloam::cli
