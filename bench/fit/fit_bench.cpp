// Fits the coefficients of the technique `evidence` to ray-traced truth. Prints a leave-one-scene-out cross-validation: each scene is
// measured with coefficients that were fitted without it. Without --scenes, thin things (fences, leaves, hair) are measured but not fitted to.
//
// bench_fit --folder DIR [-o coefficients.h] [--scenes A,B] [--frames N] [--rays N] [--seed N]
#include <algorithm>

#include "base/files.h"
#include "bench/bench_frame.h"
#include "bench/fit/fit.h"
#include "gloam/error.h"
#include "gloam/technique.h"

namespace gloam::bench {
namespace {

constexpr int pixels_of_frame = 2500;

struct SceneSamples {
  const SceneRecipe* recipe;
  bool is_fitted;
  std::vector<FitSample> samples;
};

std::vector<const SceneRecipe*> scenes_named(const std::vector<std::string>& names) {
  std::vector<const SceneRecipe*> scenes;
  std::vector<std::string> all;
  for (const SceneRecipe& recipe : builtin_scenes()) {
    all.push_back(recipe.name);
    if (names.empty() && recipe.kind != "flat") scenes.push_back(&recipe);
  }
  for (const std::string& name : names) {
    const SceneRecipe* recipe = find_builtin_scene(name);
    if (!recipe) throw UsageError("no scene '{}'{} (gloam list scenes)", name, suggestion(name, all));
    if (std::find(scenes.begin(), scenes.end(), recipe) == scenes.end()) scenes.push_back(recipe);
  }
  return scenes;
}

/// Those of the presets, which get coefficients of their own.
std::vector<Sampling> samplings_of_presets() {
  const Technique& technique = find_technique("evidence");
  std::vector<Sampling> samplings;
  for (const Preset& preset : technique.presets) {
    ParameterValues values(technique.parameters);
    for (const auto& [name, value] : preset.settings) values.set(name, value, technique.name);
    samplings.push_back({int(values.number("directions")), int(values.number("steps"))});
  }
  return samplings;
}

/// Coefficients fitted to all scenes but one; to all for none.
Coefficients fitted_without(const std::vector<SceneSamples>& scenes, const SceneRecipe* left_out) {
  std::vector<const std::vector<FitSample>*> lists;
  for (const SceneSamples& scene : scenes) {
    if (scene.recipe != left_out && scene.is_fitted) lists.push_back(&scene.samples);
  }
  return fitted(lists);
}

/// Leave-one-scene-out, a table in Markdown.
void print_cross_validation(const std::vector<SceneSamples>& scenes, Sampling sampling) {
  fmt::print("\n{} x {} x 2 samples\n\n| scene | kind | gtao | bitmask | evidence |\n|---|---|---|---|---|\n",
             sampling.directions, sampling.steps);
  for (const SceneSamples& scene : scenes) {
    fmt::print("| {} | {}{} | {:.4f} | {:.4f} | {:.4f} |\n", scene.recipe->name, scene.recipe->kind,
               scene.is_fitted ? "" : ", not fitted to", rmse(scene.samples, &FitSample::gtao),
               rmse(scene.samples, &FitSample::bitmask), rmse(scene.samples, fitted_without(scenes, scene.recipe)));
  }
  std::fflush(stdout);
}

std::string header_of(const std::vector<std::string>& rows, const std::string& provenance) {
  std::string text =
      "// Coefficients of evidence.cl, by slices a pixel and samples on each side of a slice. Made by script/fit.\n" +
      provenance +
      "#ifndef GLOAM_EVIDENCE_COEFFICIENTS_H\n#define GLOAM_EVIDENCE_COEFFICIENTS_H\n\n"
      "// In the order of evidence.cl: a, b, u, aa, ab, bb, au, bu, uu, af, bf, uf.\n"
      "// clang-format off\n#define EVIDENCE_COEFFICIENTS(SET)";
  for (const std::string& row : rows) text += " \\\n  " + row;
  return text + "\n// clang-format on\n\n#endif\n";
}

int bench_main(int argc, char** argv) {
  TrainingOptions options;
  std::string output;
  std::vector<std::string> names;
  CLI::App flags;
  flags.add_option("--folder", options.folder)->required();
  flags.add_option("-o,--output", output);
  flags.add_option("--scenes", names)->delimiter(',');
  flags.add_option("--frames", options.frames)->check(CLI::Range(1, 1000));
  flags.add_option("--rays", options.rays)->check(CLI::Range(1, 65536));
  flags.add_option("--seed", options.seed);
  take_flags(flags, argc, argv);
  if (argc > 1) throw UsageError("unknown argument '{}'", argv[1]);
  options.progress = [](const std::string& file) { fmt::print(stderr, "making {}\n", file); };
  const std::vector<const SceneRecipe*> recipes = scenes_named(names);
  if (recipes.size() < 2)
    throw UsageError("--scenes {}: at least two, since each is measured by a fit to the others", names[0]);
  if (!output.empty()) {
    if (const std::string why = why_unwritable(output); !why.empty()) throw Error("{}: {}", output, why);
  }
  std::error_code failed;
  std::filesystem::create_directories(options.folder, failed);
  if (failed) throw Error("--folder {}: cannot be made: {}", options.folder.string(), failed.message());
  // Scenes named by --scenes are all fitted to.
  const auto is_fitted = [&](const SceneRecipe& recipe) { return !names.empty() || recipe.kind != "thin"; };
  const std::vector<Sampling> samplings = samplings_of_presets();
  std::vector<std::vector<SceneSamples>> by_sampling(samplings.size());
  Device device;
  for (const SceneRecipe* recipe : recipes) {
    const std::vector<TrainingFrame> frames = training_frames(*recipe, options);
    for (size_t i = 0; i < samplings.size(); ++i) {
      SceneSamples scene{recipe, is_fitted(*recipe), {}};
      for (const TrainingFrame& frame : frames) {
        const std::vector<FitSample> samples = fit_samples(frame, samplings[i], device, pixels_of_frame);
        scene.samples.insert(scene.samples.end(), samples.begin(), samples.end());
      }
      by_sampling[i].push_back(std::move(scene));
    }
  }

  std::vector<std::string> rows;
  for (size_t i = 0; i < samplings.size(); ++i) {
    print_cross_validation(by_sampling[i], samplings[i]);
    std::string row = fmt::format("SET({}, {}", samplings[i].directions, samplings[i].steps);
    for (const double c : fitted_without(by_sampling[i], nullptr)) row += fmt::format(", {:.4f}f", c);
    rows.push_back(row + ")");
  }
  std::string scenes;
  for (const SceneRecipe* recipe : recipes) {
    if (is_fitted(*recipe)) scenes += (scenes.empty() ? "" : ", ") + recipe->name;
  }
  const std::string provenance = fmt::format(
      "// Fitted to {} frames of each of {}, {}x{}, radius {:g} to {:g} pixels at the median depth, {} rays a pixel, "
      "seed {}.\n",
      options.frames, scenes, options.width, options.height, options.least_pixels, options.most_pixels, options.rays,
      options.seed);
  const std::string header = header_of(rows, provenance);
  if (output.empty()) {
    fmt::print("\n{}", header);
    return 0;
  }
  write_text(output, header);
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) { return gloam::bench::run_program("bench_fit", argc, argv, gloam::bench::bench_main); }
