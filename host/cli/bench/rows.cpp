#include "cli/bench/rows.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

/// Names as a list for a flag.
std::string comma_list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ",")); }

const report::Scene* scene_of(const report::Source& source, const std::string& name) {
  for (const report::Scene& scene : source.measurements.scenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

bool is_builtin(const std::string& name) {
  const std::vector<SceneRecipe>& all = builtin_scenes();
  return std::any_of(all.begin(), all.end(), [&](const SceneRecipe& recipe) { return recipe.name == name; });
}

bool is_known(const std::string& technique) {
  return std::any_of(registry().begin(), registry().end(), [&](const Technique& t) { return t.name == technique; });
}

std::string command_of(const report::Source& source) {
  const std::vector<std::string>& words = source.measurements.command;
  return words.empty() ? "not in the file" : shell_line(words);
}

/// Throws Error for scenes that are none of the built-in ones, without a frame in their place.
void check_scenes(const BenchCommand& flags, const report::Source& source, const std::vector<std::string>& scenes) {
  const report::SetFacts& set = source.measurements.set;
  if (!set.name.empty() && flags.set.empty())
    throw Error("{}: is of the set {}, whose frames are files; --set DIR says where they are", source.name, set.name);
  if (set.name.empty() && !flags.set.empty())
    throw Error("{}: is not of a set; leave --set {} out", source.name, flags.set);
  if (!flags.set.empty()) return;
  if (!flags.frame.empty()) {
    if (scenes.size() == 1) return;
    throw Error("{}: is of {} scenes, and --frame {} is one; leave --frame out", source.name, scenes.size(),
                flags.frame);
  }
  for (const std::string& scene : scenes) {
    if (!is_builtin(scene))
      throw Error("{}: was measured on '{}', which is no built-in scene; give --frame and --truth as then: {}",
                  source.name, scene, command_of(source));
  }
}

/// A number of a file of anybody as a whole one.
int whole(double number) { return int(std::clamp(number, 0.0, 1e9)); }

std::optional<Size> size_of(const report::Source& source) {
  std::optional<Size> size;
  for (const report::Row& row : source.measurements.rows) {
    if (!row.width || !row.height) continue;
    const Size of_row{whole(*row.width), whole(*row.height)};
    if (size && *size != of_row)
      throw Error("{}: has rows of several sizes; compare files of one size each", source.name);
    size = of_row;
  }
  return size;
}

/// The radius that was given by a flag, if it was: other scenes have their own.
std::optional<double> given_radius(const report::Source& source) {
  const std::vector<report::Scene>& scenes = source.measurements.scenes;
  return !scenes.empty() && scenes.front().radius_from == "flag" ? scenes.front().radius : std::nullopt;
}

int rounds_of(const report::Source& source) {
  double rounds = 0;
  for (const report::Row& row : source.measurements.rows) {
    const double all = double(row.ms.rounds.size());
    rounds = std::max(rounds, row.processes.empty() ? all : row.processes.front());
  }
  return int(rounds);
}

int processes_of(const report::Source& source) {
  size_t processes = 1;
  for (const report::Row& row : source.measurements.rows) processes = std::max(processes, row.processes.size());
  return int(processes);
}

}  // namespace

BenchCommand flags_for_rows(BenchCommand flags, const report::Source& source, std::vector<bench::WantedRow>& rows) {
  std::vector<std::string> techniques, scenes, effects;
  for (const report::Row& row : source.measurements.rows) {
    if (!is_known(row.technique) || row.preset == "submitted") continue;
    const report::Scene* scene = scene_of(source, row.scene);
    rows.push_back(
        {row.technique, row.preset, row.variant, flags.frame.empty() && scene ? scene->title : "", row.effect});
    add_new(techniques, row.technique);
    add_new(effects, row.effect);
    add_new(scenes, scene ? scene->title : row.scene);
  }
  if (rows.empty()) throw Error("{}: has no row of a technique that this gloam has", source.name);
  check_scenes(flags, source, scenes);
  flags.techniques = comma_list(techniques);
  if (!flags.set.empty())
    flags.items = comma_list(scenes);
  else if (flags.frame.empty())
    flags.scenes = comma_list(scenes);
  flags.effects = comma_list(effects);
  flags.variants = "none";
  if (flags.frame.empty() && flags.set.empty() && !flags.size) flags.size = size_of(source);
  if (!flags.radius) flags.radius = given_radius(source);
  if (!flags.rays && source.measurements.rays) flags.rays = whole(*source.measurements.rays);
  if (flags.app->count("--rounds") == 0 && rounds_of(source) > 0) flags.rounds = rounds_of(source);
  if (flags.processes == 0) flags.processes = processes_of(source);
  flags.ladder = bench::LadderFor::none;
  flags.no_growth = flags.no_checks = flags.no_images = true;
  return flags;
}

void add_rows_flags(CLI::App& app, BenchCommand& flags) {
  const Heading heading(app, "Earlier results");
  CLI::Option* rows = add_text(app, "--rows", flags.rows, "BENCH.json",
                               "measure the rows of this result again, times and errors, and nothing else");
  CLI::Option* baseline =
      add_text(app, "--baseline", flags.baseline, "BENCH.json",
               "the same, and say which rows are slower or farther from the truth; exit status 1 if any is")
          ->excludes(rows);
  add_choice(app, "--regression", flags.regression,
             {{"time", Regression::time}, {"error", Regression::error}, {"both", Regression::both}},
             "with --baseline: what fails; default both")
      ->needs(baseline);
  add_number(
      app, "--processes", flags.processes, {1, 100},
      "start so many processes, one after another, and measure the times in each: the same build is a few per cent "
      "faster in one process than in the next; default 1, with --rows and --baseline as many as then",
      "N");
  for (const char* chosen :
       {"--effects", "--techniques", "--presets", "--scenes", "--variants", "--sweep", "--ladder", "--no-growth",
        "--no-checks", "--no-images", "--sequence", "--chunks", "--time", "--items"}) {
    rows->excludes(app.get_option(chosen));
    baseline->excludes(app.get_option(chosen));
  }
  for (const char* other : {"--sequence", "--time"}) app.get_option("--processes")->excludes(app.get_option(other));
}

}  // namespace gloam::cli
