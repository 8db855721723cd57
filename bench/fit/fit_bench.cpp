// Fits the coefficients of the technique `evidence` to ray-traced truth. Prints leave-one-scene-out cross-validations: each scene is
// measured with coefficients that were fitted without it.
//
// bench_fit --folder DIR [-o coefficients.json] [--scenes A,B,scene.glb] [--occluders depth,peel] [--presets medium] [--frames N]
//           [--rays N] [--seed N] [--keep coefficients.json]
// --keep: the coefficients of AO are those of that file; only its expected error is fitted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/lists.h"
#include "bench/bench_frame.h"
#include "fit/fit.h"
#include "gloam/error.h"
#include "gloam/scene/scene.h"
#include "gloam/technique.h"

namespace gloam::bench {
namespace {

// Leaves and hair have larger errors than all else together: with the same weight they would cost rooms and streets 2 % and win 4 %
// for themselves. Only where users name the scenes do all count alike.
constexpr double weight_of_thin = 0.1;

struct SceneSamples {
  TrainingScene scene;
  double weight;
  std::vector<FitSample> samples;
};

std::vector<TrainingScene> scenes_named(const std::vector<std::string>& names) {
  std::vector<TrainingScene> scenes;
  std::vector<std::string> all;
  for (const SceneRecipe& recipe : builtin_scenes()) {
    all.push_back(recipe.name);
    if (names.empty() && recipe.kind != "flat") scenes.push_back({recipe.name, recipe.kind});
  }
  for (const std::string& name : names) {
    const SceneRecipe* recipe = find_builtin_scene(name);
    if (!recipe && !std::filesystem::exists(name))
      throw UsageError("--scenes {}: neither a file nor a built-in scene{} (gloam list scenes)", name,
                       suggestion(name, all));
    const bool is_known =
        std::any_of(scenes.begin(), scenes.end(), [&](const TrainingScene& scene) { return scene.name == name; });
    if (!is_known) scenes.push_back({name, recipe ? recipe->kind : "own"});
  }
  return scenes;
}

/// Those of the presets, which get coefficients of their own.
std::vector<Sampling> samplings_for(const std::vector<std::string>& occluders,
                                    const std::vector<std::string>& presets) {
  const Technique& technique = find_technique("evidence");
  std::vector<std::string> known;
  for (const Preset& preset : technique.presets) known.push_back(preset.name);
  for (const std::string& name : presets) {
    if (!contains(known, name))
      throw UsageError("--presets {}: there is no such preset{}; there are {}", name, suggestion(name, known),
                       enumerate(known));
  }
  std::vector<Sampling> samplings;
  for (const std::string& kind : occluders) {
    for (const Preset& preset : technique.presets) {
      if (!presets.empty() && !contains(presets, preset.name)) continue;
      ParameterValues values(technique.parameters);
      for (const auto& [name, value] : preset.settings) values.set(name, value, technique.name);
      samplings.push_back({kind, int(values.number("directions")), int(values.number("steps"))});
    }
  }
  return samplings;
}

/// The scenes of each sampling, of those that know occluders by the same means.
using Samplings = std::vector<std::vector<SceneSamples>>;

/// The coefficients of AO as sets of a file have them. Throws UsageError where they have none for a sampling.
Fit kept_fit(const std::vector<EvidenceSet>& kept, const Sampling& sampling) {
  const EvidenceSet* set = nearest_set(kept, sampling.occluders, sampling.directions, sampling.steps);
  if (!set)
    throw UsageError("--keep: has no coefficients for occluders by {}; fit these without it", sampling.occluders);
  Fit fit;
  std::copy(set->closed.begin(), set->closed.end(), fit.closed.begin());
  return fit;
}

/// Fitted to all scenes but one, by its number; to all for -1. With `kept`, only the error.
std::vector<Fit> fitted_without(const Samplings& samplings, int left_out, const std::vector<Sampling>& of,
                                const std::vector<EvidenceSet>& kept) {
  std::vector<std::vector<FitGroup>> groups;
  for (const std::vector<SceneSamples>& scenes : samplings) {
    std::vector<FitGroup>& of_sampling = groups.emplace_back();
    for (size_t k = 0; k < scenes.size(); ++k) {
      if (int(k) != left_out) of_sampling.push_back({&scenes[k].samples, scenes[k].weight});
    }
  }
  if (kept.empty()) return fitted(groups);
  std::vector<Fit> fits;
  for (size_t k = 0; k < of.size(); ++k) fit_error(groups[k], fits.emplace_back(kept_fit(kept, of[k])));
  return fits;
}

/// Sums over the pixels between two distances to the border of the image.
struct Band {
  float from, to;
  double expected = 0, actual = 0, squares = 0;
  long long pixels = 0;
};

void print_bands(const std::vector<SceneSamples>& scenes, const std::vector<Fit>& fits) {
  std::vector<Band> bands = {{0, 0.01f}, {0.01f, 0.02f}, {0.02f, 0.04f}, {0.04f, 0.1f}, {0.1f, 1}};
  for (size_t k = 0; k < scenes.size(); ++k) {
    if (scenes[k].weight < 1) continue;
    for (const FitSample& s : scenes[k].samples) {
      const double actual = std::abs(fits[k].ao(s) - double(s.truth));
      for (Band& band : bands) {
        if (s.to_border < band.from || s.to_border >= band.to) continue;
        band.expected += fits[k].expected_error(s), band.actual += actual, band.squares += actual * actual;
        ++band.pixels;
      }
    }
  }
  fmt::print("\n| distance to the border, image widths | expected error | actual error | RMSE |\n|---|---|---|---|\n");
  for (const Band& b : bands)
    fmt::print("| {:g} to {:g} | {:.4f} | {:.4f} | {:.4f} |\n", b.from, b.to, b.expected / double(b.pixels),
               b.actual / double(b.pixels), std::sqrt(b.squares / double(b.pixels)));
}

/// Leave-one-scene-out, as tables in Markdown. `fits`: for each scene, without it.
void print_cross_validation(const std::vector<SceneSamples>& scenes, const std::vector<Fit>& fits,
                            const Sampling& sampling) {
  fmt::print(
      "\nOccluders by {}, {} x {} x 2 samples\n\n| scene | kind | gtao | bitmask | evidence | open pixels over .03 too "
      "dark, % |\n|---|---|---|---|---|---|\n",
      sampling.occluders, sampling.directions, sampling.steps);
  std::map<std::string, std::vector<std::pair<double, double>>> errors;
  std::map<std::string, std::array<double, 5>> sums;
  for (size_t k = 0; k < scenes.size(); ++k) {
    const SceneSamples& scene = scenes[k];
    const Fit& fit = fits[k];
    const double gtao = rmse(scene.samples, &FitSample::gtao), bitmask = rmse(scene.samples, &FitSample::bitmask),
                 evidence = rmse(scene.samples, fit), dark = 100 * share_too_dark(scene.samples, fit);
    fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.1f} |\n", scene.scene.name, scene.scene.kind, gtao, bitmask,
               evidence, dark);
    std::array<double, 5>& sum = sums[scene.scene.kind];
    sum = {sum[0] + 1, sum[1] + gtao, sum[2] + bitmask, sum[3] + evidence, sum[4] + dark};
    for (const FitSample& s : scene.samples)
      errors[scene.weight < 1 ? "thin" : "others"].emplace_back(fit.expected_error(s),
                                                                std::abs(fit.ao(s) - double(s.truth)));
  }
  for (const auto& [kind, sum] : sums)
    fmt::print("| mean | {} | {:.4f} | {:.4f} | {:.4f} | {:.1f} |\n", kind, sum[1] / sum[0], sum[2] / sum[0],
               sum[3] / sum[0], sum[4] / sum[0]);
  for (const auto& [kind, pixels] : errors) {
    fmt::print("\nExpected and actual absolute error by decile, {}:", kind);
    for (const Decile& d : deciles(pixels)) fmt::print(" {:.4f} {:.4f},", d.expected, d.actual);
    fmt::print("\n");
  }
  print_bands(scenes, fits);
  std::fflush(stdout);
}

/// Four digits: more would say more than the fit knows.
double rounded_number(double n) { return std::round(n * 1e4) / 1e4; }

template <typename List>
nlohmann::ordered_json rounded(const List& numbers) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const double n : numbers) list.push_back(rounded_number(n));
  return list;
}

/// Prints cross-validations of samplings that are fitted together. Returns their sets, fitted to all scenes.
std::vector<nlohmann::ordered_json> sets_of(const Samplings& together, const std::vector<Sampling>& samplings,
                                            const std::vector<EvidenceSet>& kept) {
  std::vector<std::vector<Fit>> without(samplings.size());
  for (size_t k = 0; k < together.front().size(); ++k) {
    const std::vector<Fit> fits = fitted_without(together, int(k), samplings, kept);
    for (size_t i = 0; i < samplings.size(); ++i) without[i].push_back(fits[i]);
  }
  const std::vector<Fit> fits = fitted_without(together, -1, samplings, kept);
  std::vector<nlohmann::ordered_json> sets;
  for (size_t i = 0; i < samplings.size(); ++i) {
    print_cross_validation(together[i], without[i], samplings[i]);
    sets.push_back({{"occluders", samplings[i].occluders},
                    {"directions", samplings[i].directions},
                    {"steps", samplings[i].steps},
                    {"closed", rounded(fits[i].closed)},
                    {"error", rounded(fits[i].error)},
                    {"outside", rounded_number(fits[i].outside)}});
  }
  return sets;
}

/// A set a line.
std::string document_of(const std::vector<nlohmann::ordered_json>& sets, const std::string& provenance) {
  std::string text = fmt::format(
      "{{\n\"fitted\": {},\n\"sets\": [",
      nlohmann::ordered_json(provenance).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  for (size_t i = 0; i < sets.size(); ++i) text += (i == 0 ? "\n" : ",\n") + sets[i].dump();
  return text + "\n]\n}\n";
}

int bench_main(int argc, char** argv) {
  TrainingOptions options;
  std::string output, keep;
  std::vector<std::string> names, presets, occluders;
  const std::vector<std::string> kinds = {"depth", "back_depth", "peel", "stochastic"};
  CLI::App flags;
  flags.add_option("--folder", options.folder)->required();
  flags.add_option("-o,--output", output);
  flags.add_option("--keep", keep);
  flags.add_option("--scenes", names)->delimiter(',');
  flags.add_option("--occluders", occluders)->delimiter(',');
  flags.add_option("--presets", presets)->delimiter(',');
  flags.add_option("--frames", options.frames)->check(CLI::Range(1, 1000));
  flags.add_option("--rays", options.rays)->check(CLI::Range(1, 65536));
  flags.add_option("--seed", options.seed);
  take_flags(flags, argc, argv);
  if (argc > 1) throw UsageError("unknown argument '{}'", argv[1]);
  options.progress = [](const std::string& file) { fmt::print(stderr, "making {}\n", file); };
  for (const std::string& kind : occluders) {
    if (!contains(kinds, kind))
      throw UsageError("--occluders {}: is not allowed{}; {} are", kind, suggestion(kind, kinds), enumerate(kinds));
  }
  if (occluders.empty()) occluders = kinds;
  const std::vector<EvidenceSet> kept =
      keep.empty() ? std::vector<EvidenceSet>() : evidence_sets(read_text(keep), keep);
  options.with_layers =
      std::any_of(occluders.begin(), occluders.end(), [](const std::string& kind) { return kind != "depth"; });
  const std::vector<TrainingScene> named = scenes_named(names);
  if (named.size() < 2)
    throw UsageError("--scenes {}: at least two, since each is measured by a fit to the others", names[0]);
  if (!output.empty()) {
    if (const std::string why = why_unwritable(output); !why.empty()) throw Error("{}: {}", output, why);
  }
  std::error_code failed;
  std::filesystem::create_directories(options.folder, failed);
  if (failed) throw Error("--folder {}: cannot be made: {}", options.folder.string(), failed.message());
  const std::vector<Sampling> samplings = samplings_for(occluders, presets);
  std::vector<std::vector<SceneSamples>> by_sampling(samplings.size());
  Device device;
  for (const TrainingScene& scene : named) {
    const std::vector<TrainingFrame> frames = training_frames(scene, options);
    for (size_t i = 0; i < samplings.size(); ++i) {
      SceneSamples of_scene{scene, names.empty() && scene.kind == "thin" ? weight_of_thin : 1, {}};
      for (const TrainingFrame& frame : frames) {
        const std::vector<FitSample> samples = fit_samples(frame, samplings[i], device);
        of_scene.samples.insert(of_scene.samples.end(), samples.begin(), samples.end());
      }
      by_sampling[i].push_back(std::move(of_scene));
    }
  }

  std::vector<nlohmann::ordered_json> sets;
  // The samplings of each kind of occluders are fitted together.
  for (size_t first = 0; first < samplings.size();) {
    size_t last = first;
    while (last < samplings.size() && samplings[last].occluders == samplings[first].occluders) ++last;
    const Samplings together(std::move_iterator(by_sampling.begin() + std::ptrdiff_t(first)),
                             std::move_iterator(by_sampling.begin() + std::ptrdiff_t(last)));
    const std::vector<nlohmann::ordered_json> fitted =
        sets_of(together, {samplings.begin() + std::ptrdiff_t(first), samplings.begin() + std::ptrdiff_t(last)}, kept);
    sets.insert(sets.end(), fitted.begin(), fitted.end());
    first = last;
  }
  std::vector<std::string> scenes;
  for (const TrainingScene& scene : named)
    scenes.push_back(scene.kind == "own" ? std::filesystem::path(scene.name).filename().string() : scene.name);
  const std::string provenance = fmt::format(
      "{} frames of each of {}, {}x{}, radius {:g} to {:g} pixels at the median depth, {} rays a pixel, seed {}{}; "
      "pixels with a truth of {:g} or more count {:g}",
      options.frames, fmt::join(scenes, ", "), options.width, options.height, options.least_pixels, options.most_pixels,
      options.rays, options.seed, names.empty() ? fmt::format("; scenes of kind thin count {:g}", weight_of_thin) : "",
      least_open, weight_of_open);
  const std::string document = document_of(sets, provenance);
  if (output.empty())
    fmt::print("\n{}", document);
  else
    write_text(output, document);
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) { return gloam::bench::run_program("bench_fit", argc, argv, gloam::bench::bench_main); }
