// gloam bench -o DIR: what accuracy costs in time
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <thread>

#include "commit.h"
#include "gloam/error.h"
#include "growth.h"
#include "ladder.h"
#include "native.h"
#include "plans.h"
#include "race.h"
#include "scene_flags.h"
#include "subject.h"
#include "timing.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

const std::vector<std::string> default_scenes = {"courtyard", "corridor", "colonnade", "gallery"};
constexpr int peeled_layers = 8;
constexpr int growth_rounds = 5;

struct BenchCommand {
  std::string folder, techniques, scenes, presets, frame, truth, size = "960x540", rays = "256", radius, rounds = "9",
                                                                 device;
  bool no_growth = false;
  FrameFlags frame_flags;
  JsonFlag json;
};

/// What is asked for, checked.
struct Options {
  std::vector<const Technique*> techniques;
  std::vector<std::string> presets;  ///< empty: all
  std::vector<const SceneRecipe*> scenes;
  SceneOptions scene;
  int rounds = 9;
  bool growth = true;
};

/// One row of the table.
struct Row : Racer {
  std::string scene;
  int width = 0, height = 0;
  Ladder ladder;
};

struct Skipped {
  std::string technique, preset, scene, why;
};

struct Report {
  std::vector<std::unique_ptr<Row>> rows;
  std::vector<Skipped> skipped;
  Json growth = Json::array(), scenes = Json::array();
};

/// A frame that is measured on.
struct Subject {
  std::string name;
  Frame frame;
  std::string holds;  ///< "beauty.exr has only R, G, B"
  double radius = 0.5;
  std::optional<Truth> given;      ///< --truth
  const Truth* truth = nullptr;    ///< that, or traced; null: none
  std::unique_ptr<Truths> truths;  ///< where the scene is at hand
};

// --- Showing what goes on

void erase_status() {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
}

/// On a terminal, what is being done; it is written over.
void show(const std::string& what, double share) {
  if (!isatty(STDERR_FILENO)) return;
  fmt::print(stderr, "\r\033[K{} {:.0f} %", printable(what), 100 * share);
  std::fflush(stderr);
}

// --- What is asked for

std::vector<std::string> techniques_with_ao() {
  std::vector<std::string> names;
  for (const Technique& t : registry()) {
    if (contains(outputs_of(t), "ao") && !is_filter(t)) names.push_back(t.name);
  }
  return names;
}

/// Empty, or why a technique has no place in the table.
std::string no_ao(const Technique& technique) {
  if (is_filter(technique)) return "is a filter: its time is part of the techniques that it follows";
  if (!contains(outputs_of(technique), "ao")) return fmt::format("makes {}, not ao", enumerate(technique.writes));
  return "";
}

void choose_techniques(Options& options, const std::string& list, Report& report) {
  for (const Technique& t : registry()) {
    const std::string why = no_ao(t);
    if (!list.empty()) continue;
    if (why.empty())
      options.techniques.push_back(&t);
    else
      report.skipped.push_back({t.name, "", "", why});
  }
  // Truths that several share are named after the one over a single layer.
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

Options options_of(const BenchCommand& flags, Report& report) {
  Options options;
  choose_techniques(options, flags.techniques, report);
  choose_presets(options, flags.presets);
  if (flags.frame.empty()) choose_scenes(options, flags.scenes);
  std::tie(options.scene.width, options.scene.height) = parse_size(flags.size, "--size");
  options.scene.layers = peeled_layers;
  options.scene.rays = parse_whole_number(flags.rays, "--rays", 1, 1 << 24);
  if (!flags.radius.empty()) options.scene.radius = parse_number(flags.radius, "--radius", 1e-30, 1e30);
  options.scene.folder = std::filesystem::path(flags.folder) / "scenes";
  options.scene.progress = show;
  options.rounds = parse_whole_number(flags.rounds, "--rounds", 1, 10000);
  options.growth = !flags.no_growth;
  return options;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("-o {}: cannot be made ({})", folder.string(), error.message());
}

// --- Frames

std::vector<std::string> presets_of(const Technique& technique, const Options& options) {
  std::vector<std::string> names;
  for (const Preset& preset : technique.presets) {
    if (options.presets.empty() || contains(options.presets, preset.name)) names.push_back(preset.name);
  }
  if (technique.presets.empty() && options.presets.empty()) names.push_back("");
  return names;
}

/// What any technique takes of a file, and what the baselines and the figures need.
std::vector<std::string> planes_to_read(const FrameFile& file, const Options& options) {
  const std::vector<std::string> available = file.common_planes();
  std::vector<std::string> planes;
  for (const char* plane : {"depth", "normal"}) {
    if (contains(available, plane)) planes.push_back(plane);
  }
  for (const Technique* t : options.techniques) {
    for (const Technique* each : {t, over_all_layers(*t)}) {
      if (!each) continue;
      try {
        for (const std::string& plane : whole_plan({each, "", 0.5}, available, "").inputs) add_new(planes, plane);
      } catch (const MissingPlanes&) {  // said where it is skipped
      }
    }
  }
  return planes;
}

void read_frame(Subject& subject, FrameFile& file, const Options& options) {
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: has no depth to measure on; {}", file.path().string(), holdings(file));
  subject.holds = holdings(file);
  subject.frame = file.read(planes_to_read(file, options));
  note(subject.frame.assumed);
}

void trace_truth(Subject& subject) {
  try {
    subject.truth = &subject.truths->truth(subject.frame);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {  // another camera, another scene: then there is no truth
    note({fmt::format("{}: no truth: {}", subject.name, error.what())});
    subject.truths.reset();
  }
}

Subject builtin_subject(const SceneRecipe& recipe, const Options& options) {
  Subject subject;
  subject.name = recipe.name;
  show(recipe.name + ": scene", 0);
  subject.truths = std::make_unique<Truths>(recipe.name, load_scene(recipe.name, {}), options.scene);
  subject.radius = subject.truths->radius();
  FrameFile file(subject.truths->frame_file(), {});
  read_frame(subject, file, options);
  subject.truth = &subject.truths->truth(subject.frame);
  return subject;
}

/// The user's frame. Its scene is at hand where the header names a built-in one.
Subject own_subject(const BenchCommand& flags, const Options& options) {
  Subject subject;
  FrameFile file(flags.frame, flags.frame_flags.read_options());
  subject.name = file.path().stem().string();
  read_frame(subject, file, options);
  std::optional<double> radius = options.scene.radius;
  if (!flags.truth.empty()) {
    subject.given = read_truth(flags.truth, subject.frame);
    subject.truth = &*subject.given;
    const std::optional<double> traced = subject.given->radius;
    if (radius && traced && std::abs(*traced - *radius) > 1e-6 * *traced)
      throw UsageError("--radius {:g}: the truth was made with {:g}; leave it out, or trace another truth", *radius,
                       *traced);
    if (!radius) radius = traced;
  }
  const SceneFlags scene = scene_named_by(file.text_attribute("gloamScene"));
  if (find_builtin_scene(scene.scene)) {
    SceneOptions with_radius = options.scene;
    with_radius.radius = radius;
    subject.truths = std::make_unique<Truths>(subject.name, scene.load(), with_radius);
    radius = subject.truths->radius();
    if (!subject.truth) trace_truth(subject);
  }
  subject.radius = radius.value_or(subject.radius);
  if (!std::isfinite(subject.radius) || !(subject.radius > 0))
    throw Error("{}: was made with radius {:g}; --radius gives one that can be measured", flags.truth, subject.radius);
  return subject;
}

// --- One frame

void measure_growth_of(const Subject& subject, const std::vector<const Technique*>& techniques, Device& device,
                       Report& report) {
  for (size_t i = 0; i < techniques.size(); ++i) {
    show(fmt::format("{}: growth of {}", subject.name, techniques[i]->name), double(i) / double(techniques.size()));
    for (const Growth& growth :
         measure_growth(*techniques[i], subject.frame, device, {subject.radius, growth_rounds})) {
      Json points = Json::array();
      for (const GrowthPoint& p : growth.points) points.push_back({{"x", p.x}, {"ms", p.ms}});
      report.growth.push_back({{"technique", techniques[i]->name},
                               {"over", growth.over},
                               {"scene", subject.name},
                               {"exponent", *exponent(growth.points)},
                               {"points", points}});
    }
  }
}

void add_scene(const Subject& subject, Report& report) {
  Json entry = {{"name", subject.name},
                {"size", {subject.frame.width(), subject.frame.height()}},
                {"radius", subject.radius},
                {"radius_pixels", median_reach(subject.frame, subject.radius)},
                {"truth_noise", nullptr}};
  if (subject.truth && subject.truth->noise) entry["truth_noise"] = *subject.truth->noise;
  if (subject.truths) {
    entry["made"] = subject.truths->made();
    entry["reused"] = subject.truths->reused();
    if (!subject.truths->reused().empty())
      note({fmt::format("{} of an earlier run used again", enumerate(subject.truths->reused()))});
  }
  report.scenes.push_back(entry);
}

/// Why a technique was skipped, without the name that goes before it.
std::string why(const Technique& technique, const Error& error) {
  const std::string message = error.what(), prefix = technique.name + ": ";
  return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
}

/// Enters a technique's presets that the frame and the device allow.
std::vector<std::unique_ptr<Row>> rows_of(const Technique& technique, const Subject& subject, const Options& options,
                                          Steps& steps, Race& race, Report& report) {
  std::vector<std::unique_ptr<Row>> rows;
  const std::vector<std::string> presets = presets_of(technique, options);
  if (presets.empty()) report.skipped.push_back({technique.name, "", subject.name, "has none of these presets"});
  for (const std::string& preset : presets) {
    auto row = std::make_unique<Row>();
    row->variation = {&technique, preset, subject.radius};
    row->scene = subject.name;
    row->width = subject.frame.width();
    row->height = subject.frame.height();
    show(fmt::format("{}: images of {} {}", subject.name, technique.name, preset), 0);
    try {
      row->ladder = steps.climb(row->variation);
      race.enter(*row);
      rows.push_back(std::move(row));
    } catch (const UsageError&) {
      throw;
    } catch (const MissingPlanes& missing) {  // the same for every preset
      report.skipped.push_back({technique.name, "", subject.name, why(technique, missing)});
      break;
    } catch (const Error& error) {
      report.skipped.push_back({technique.name, preset, subject.name, why(technique, error)});
    }
  }
  return rows;
}

void measure(Subject& subject, const Options& options, bool growth, Device& device, Report& report) {
  Race race(subject.frame, subject.holds, subject.radius, device);
  Steps steps(subject.frame, subject.holds, device, subject.truth, subject.truths.get());
  std::vector<const Technique*> measured;
  for (const Technique* technique : options.techniques) {
    std::vector<std::unique_ptr<Row>> rows = rows_of(*technique, subject, options, steps, race, report);
    if (!rows.empty()) measured.push_back(technique);
    for (auto& row : rows) report.rows.push_back(std::move(row));
  }
  if (!measured.empty()) {
    race.run(options.rounds, [&](int done, int of) {
      show(fmt::format("{}: all plans in turn, round", subject.name), double(done) / of);
    });
  }
  note(race.notes());
  if (growth) measure_growth_of(subject, measured, device, report);
  add_scene(subject, report);
  erase_status();
}

// --- The document

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// What can be given to --set: names without a dot are the technique's own.
Json settings_of(const Plan& plan, const Technique& technique) {
  Json settings = Json::object();
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.values.table()) {
      const std::string name = planned.technique == &technique ? p.name : planned.technique->name + "." + p.name;
      const bool is_number = p.type == Parameter::Type::floating || p.type == Parameter::Type::integer;
      const std::string text = planned.values.text(p.name);
      settings[name] =
          is_number && std::isfinite(planned.values.number(p.name)) ? Json::parse(text, nullptr, false) : Json(text);
      if (settings[name].is_discarded()) settings[name] = text;
    }
  }
  return settings;
}

Json document_of(const Row& row) {
  Json passes = Json::array();
  for (const TimedPlan::Pass& pass : row.timed->passes())
    passes.push_back({{"name", pass.name}, {"ms", milliseconds(pass.ms)}});
  const Ladder& l = row.ladder;
  return {{"technique", row.variation.technique->name},
          {"preset", row.variation.name()},
          {"settings", settings_of(row.timed->plan(), *row.variation.technique)},
          {"scene", row.scene},
          {"width", row.width},
          {"height", row.height},
          {"lanes", row.timed->lanes()},
          {"ms", milliseconds(row.ms)},
          {"passes", passes},
          {"ratio_to_naive", number(row.to_naive)},
          {"ratio_to_native", number(row.to_native)},
          {"ratio_to_gather_floor", number(row.to_gather_floor)},
          {"ratio_to_copy_floor", number(row.to_copy_floor)},
          {"ratio_to_hbao_plus", number(row.to_hbao_plus)},
          {"rmse_to_truth", number(l.truth)},
          {"ladder",
           {{"t0w", number(l.t0w)},
            {"t1", number(l.t1)},
            {"t2", number(l.t2)},
            {"t3", number(l.t3)},
            {"t4_bias", number(l.t4_bias)},
            {"t4_noise", number(l.t4_noise)},
            {"t5", number(l.t5)}}}};
}

/// "model name" of /proc/cpuinfo; "unknown" where there is none.
std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string utc_day() {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day day(today);
  return fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()), unsigned(day.day()));
}

Json document_of(const Report& report, const Options& options, const DeviceInfo& device) {
  Json results = Json::array(), skipped = Json::array();
  for (const auto& row : report.rows) results.push_back(document_of(*row));
  for (const Skipped& s : report.skipped)
    skipped.push_back({{"technique", s.technique},
                       {"preset", s.preset.empty() ? Json(nullptr) : Json(s.preset)},
                       {"scene", s.scene.empty() ? Json(nullptr) : Json(s.scene)},
                       {"why", s.why}});
  return {{"device", device.name},
          {"cpu", cpu_model()},
          {"cores", std::thread::hardware_concurrency()},
          {"driver", fmt::format("{} {}", device.platform, device.driver)},
          {"date", utc_day()},
          {"commit", commit},
          {"rounds", options.rounds},
          {"rays", options.scene.rays},
          {"scenes", report.scenes},
          {"results", results},
          {"growth", report.growth},
          {"skipped", skipped},
          {"paper", Json::array()}};
}

// --- The table

std::string cell(const std::optional<double>& value, const char* format = "{:.4f}") {
  return value && std::isfinite(*value) ? fmt::format(fmt::runtime(format), *value) : "-";
}

void print_times(const Report& report) {
  fmt::print("\nTime of the whole plan, and ratios within a round: a plan's time over the other's\n");
  std::vector<std::vector<std::string>> rows = {
      {"scene", "technique", "preset", "ms", "min", "max", "/hbao+", "/gather", "/copy", "/naive", "/native"}};
  for (const auto& row : report.rows) {
    const auto [least, most] = std::minmax_element(row->ms.begin(), row->ms.end());
    rows.push_back({row->scene, row->variation.technique->name, row->variation.name(),
                    fmt::format("{:.2f}", median(row->ms)), fmt::format("{:.2f}", *least), fmt::format("{:.2f}", *most),
                    cell(row->to_hbao_plus, "{:.2f}"), cell(row->to_gather_floor, "{:.2f}"),
                    cell(row->to_copy_floor, "{:.1f}"), cell(row->to_naive, "{:.3f}"), cell(row->to_native, "{:.2f}")});
  }
  print_table(rows, 3);
}

void print_errors(const Report& report) {
  fmt::print("\nRMSE to the truth, and of each step to the one before (docs/benchmarking.md)\n");
  std::vector<std::vector<std::string>> rows = {{"scene", "technique", "preset", "truth", "t0w model", "t1 screen",
                                                 "t2 hidden", "t3 noise", "t4 bias", "t4 noise", "t5 rounding"}};
  for (const auto& row : report.rows) {
    const Ladder& l = row->ladder;
    rows.push_back({row->scene, row->variation.technique->name, row->variation.name(), cell(l.truth), cell(l.t0w),
                    cell(l.t1), cell(l.t2), cell(l.t3), cell(l.t4_bias), cell(l.t4_noise), cell(l.t5, "{:.1e}")});
  }
  print_table(rows, 3);
}

void print_growth(const Report& report) {
  if (report.growth.empty()) return;
  fmt::print("\nGrowth, without the filter: time is in proportion to x to the power of\n");
  std::vector<std::vector<std::string>> rows = {{"technique", "x", "exponent", "x from", "to", "ms from", "to"}};
  for (const Json& g : report.growth) {
    const Json &first = g["points"].front(), &last = g["points"].back();
    rows.push_back({g["technique"], g["over"], fmt::format("{:.2f}", double(g["exponent"])),
                    fmt::format("{:.0f}", double(first["x"])), fmt::format("{:.0f}", double(last["x"])),
                    fmt::format("{:.2f}", double(first["ms"])), fmt::format("{:.2f}", double(last["ms"]))});
  }
  print_table(rows, 2);
}

void print(const Report& report, const Options& options, const DeviceInfo& device) {
  fmt::print("{}, {} ({}); {} rounds\n", cpu_model(), device.name, device.platform, options.rounds);
  print_times(report);
  print_errors(report);
  print_growth(report);
  for (const Skipped& s : report.skipped) {
    const std::string where = s.scene.empty() ? "" : fmt::format(" on {}", s.scene);
    fmt::print("skipped {}{}: {}\n", s.technique, printable(where), printable(s.why));
  }
}

void bench_command(const BenchCommand& flags) {
  if (!make_openmp_wait_passively())
    note({"OMP_WAIT_POLICY=passive could not be set: threads of the native loop may take time from the others"});
  Report report;
  const Options options = options_of(flags, report);
  make_folder(options.scene.folder);
  const std::filesystem::path folder = flags.folder;
  check_paths({{"--frame", flags.frame}, {"--truth", flags.truth}, {"--camera", flags.frame_flags.camera}},
              {{"-o", (folder / "bench.json").string()},
               {"-o", (options.scene.folder / "scene.exr").string()},
               {"--json", flags.json.file()}});
  Device device(flags.device);
  if (!flags.frame.empty()) {
    Subject subject = own_subject(flags, options);
    measure(subject, options, options.growth, device, report);
  }
  for (size_t i = 0; i < options.scenes.size(); ++i) {
    Subject subject = builtin_subject(*options.scenes[i], options);
    measure(subject, options, options.growth && i == 0, device, report);
  }
  if (report.rows.empty())
    throw Error("nothing could be measured: {} {}", report.skipped.back().technique, report.skipped.back().why);
  const Json document = document_of(report, options, device.info());
  JsonFlag{(folder / "bench.json").string()}.write(document);
  flags.json.write(document);
  if (flags.json.only_json()) return;
  print(report, options, device.info());
  fmt::print("wrote {}\n", printable((folder / "bench.json").string()));
}

}  // namespace

void add_bench(CLI::App& app) {
  auto flags = std::make_shared<BenchCommand>();
  CLI::App* command =
      app.add_subcommand("bench", "what accuracy costs in time: times, ratios and errors of techniques");
  command->add_option("-o,--output", flags->folder, "folder for bench.json and scenes/; made where it is not there")
      ->required()
      ->type_name("DIR");
  command->add_option("--techniques", flags->techniques, "these only; default: all that make ao")->type_name("A,B");
  command->add_option("--presets", flags->presets, "these only; default: all that a technique has")->type_name("A,B");
  CLI::Option* scenes =
      command->add_option("--scenes", flags->scenes, "built-in scenes, or all; default: " + enumerate(default_scenes))
          ->type_name("A,B");
  CLI::Option* frame =
      command->add_option("--frame", flags->frame, "measure on this frame instead of scenes")->type_name("FRAME.exr");
  command
      ->add_option(
          "--truth", flags->truth,
          "the frame's truth, as gloam reference makes it; default: traced where the frame shows a built-in scene")
      ->type_name("REF.exr")
      ->needs(frame);
  CLI::Option* size =
      command->add_option("--size", flags->size, "of the scenes' images; default 960x540")->type_name("WxH");
  frame->excludes(scenes)->excludes(size);
  command->add_option("--rays", flags->rays, "per pixel, for truths that are traced; default 256")->type_name("N");
  command
      ->add_option("--radius", flags->radius,
                   "scene units; default: the truth's, else a built-in scene's own, else 0.5")
      ->type_name("R");
  command->add_option("--rounds", flags->rounds, "each runs everything once, in turn; default 9")->type_name("N");
  command->add_flag("--no-growth", flags->no_growth, "leave out how times grow with pixels, samples, radius ...");
  command->add_option("--device", flags->device, "part of a device's or platform's name (gloam list devices)")
      ->type_name("TEXT");
  flags->frame_flags.add_to(*command);
  for (CLI::Option* option : command->get_options()) {
    if (option->get_group() == "Reading the frame") option->needs(frame);
  }
  flags->json.add_to(*command);
  command->footer(
      "Frames and truths stay in DIR/scenes and are used again. Examples:\n"
      "  gloam bench -o out/bench\n"
      "  gloam bench -o out/bench --techniques hbao+ --scenes all --size 1920x1080\n"
      "  gloam bench -o out/mine --frame frame.exr --truth ao_ref.exr --presets low,medium");
  command->callback([flags] { bench_command(*flags); });
}

}  // namespace gloam::cli
