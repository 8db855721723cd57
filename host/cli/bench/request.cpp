#include "cli/bench/request.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"
#include "measure/effects.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

constexpr int peeled_layers = 8;
constexpr size_t most_swept = 1000;
constexpr Size sequence_size = {640, 360};

/// Those asked for, else those of the truths' files; where neither says, none, and the techniques decide.
std::vector<std::string> asked_effects(const BenchCommand& flags) {
  if (!flags.sequence.empty()) return {"ao"};
  if (!flags.effects.empty()) return parse_effects(flags.effects);
  if (!flags.truths.empty() && flags.techniques.empty()) return effects_in(flags.truths);
  return {};
}

void choose_techniques(BenchOptions& options, const BenchCommand& flags, Measurement& result) {
  const std::string& list = flags.techniques;
  const std::vector<std::string> asked = asked_effects(flags);
  options.effects = !asked.empty() ? asked : list.empty() ? std::vector<std::string>{"ao"} : effect_names();
  for (const Technique& t : registry()) {
    if (!list.empty()) continue;
    const std::string unlike = why_not_measured(t, options.effects),
                      why = unlike.empty() ? needs_naming(t, flags.variant) : unlike;
    if (why.empty() && fits(t, flags.variant))
      options.techniques.push_back(&t);
    else if (!why.empty())
      result.skipped.push_back({t.name, "", "", why});
  }
  // A truth that several techniques share has the name of the one over a single layer.
  std::stable_partition(options.techniques.begin(), options.techniques.end(),
                        [](const Technique* t) { return !reads_layers(*t); });
  if (list.empty()) return check_any_fits(options.techniques, flags.variant, options.effects);
  for (const std::string& name : split_list(list, "--techniques")) {
    const Technique& t = find_technique(variant_name(name, flags.variant));
    if (const std::string why = why_not_measured(t, options.effects); !why.empty())
      throw UsageError("--techniques {}: {}; {} can be measured", name, why,
                       enumerate(techniques_making(options.effects)));
    if (std::find(options.techniques.begin(), options.techniques.end(), &t) == options.techniques.end())
      options.techniques.push_back(&t);
  }
  std::erase_if(options.effects, [&](const std::string& effect) {
    return std::none_of(options.techniques.begin(), options.techniques.end(),
                        [&](const Technique* t) { return measured_plane(*t) == effect; });
  });
}

/// Whether hidden layers must hold light, for a technique or its form over layers.
bool reads_light_of_layers(const BenchOptions& options) {
  return std::any_of(options.techniques.begin(), options.techniques.end(), [](const Technique* t) {
    const Technique* over_layers = over_all_layers(*t);
    return over_layers && contains(over_layers->reads, "peel_color_r");
  });
}

void choose_presets(BenchOptions& options, const std::string& list) {
  if (list.empty()) return;
  std::vector<std::string> known;
  for (const Technique* t : options.techniques) {
    for (const Preset& preset : source_of(*t).presets) add_new(known, preset.name);
  }
  for (const std::string& name : split_list(list, "--presets")) {
    if (!contains(known, name))
      throw UsageError("--presets {} is not allowed{}; {} are", name, suggestion(name, known),
                       known.empty() ? "none" : enumerate(known));
    add_new(options.presets, name);
  }
}

void choose_scenes(BenchOptions& options, const std::string& list) {
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

void choose_variants(BenchOptions& options, const std::string& list, const DeviceInfo& device) {
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
void check_sweep(const BenchOptions& options, const Sweep& sweep, const std::vector<const Technique*>& swept,
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

void choose_sweeps(BenchOptions& options, const std::vector<std::string>& items, Measurement& result) {
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
void choose_growth(BenchOptions& options, const BenchCommand& flags) {
  if (flags.no_growth) return;
  for (const Technique* t : options.techniques) {
    if (!flags.techniques.empty() || !reads_layers(*t)) options.growth.push_back(t);
  }
}

}  // namespace

const std::vector<std::string> default_scenes = {"courtyard", "corridor", "colonnade", "gallery"};

BenchOptions options_of(const BenchCommand& flags, const DeviceInfo& device, Measurement& result) {
  BenchOptions options;
  choose_techniques(options, flags, result);
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
  options.scene.peel_light = reads_light_of_layers(options);
  options.scene.rays = flags.rays.value_or(options.scene.rays);
  options.scene.radius = flags.radius;
  options.scene.folder = std::filesystem::path(flags.folder) / "scenes";
  options.scene.progress = options.progress = show_status;
  options.rounds = flags.rounds;
  options.fixed_rounds = flags.app && flags.app->get_option("--rounds")->count() > 0;
  options.ladder = flags.ladder;
  if (!flags.no_images) options.folder = flags.folder;
  return options;
}

}  // namespace gloam::cli
