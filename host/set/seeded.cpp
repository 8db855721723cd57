#include "set/seeded.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/radius.h"
#include "gloam/scene/capture.h"
#include "scene/random_camera.h"

namespace gloam::sets {
namespace {

constexpr size_t items = 6;
constexpr double least_pixels = 22,
                 most_pixels = 95;  ///< reach of the radius at the median depth, at 640 pixels across
constexpr int most_trials = 200;

/// One item of the public part for each of its scenes, in an order drawn at random.
std::vector<const ItemRecipe*> drawn_scenes(const Recipe& from, Random& random) {
  std::vector<const ItemRecipe*> scenes;
  for (const ItemRecipe& item : from.items) {
    const bool is_known =
        std::any_of(scenes.begin(), scenes.end(), [&](const ItemRecipe* known) { return known->scene == item.scene; });
    if (item.kind == "frame" && !is_known) scenes.push_back(&item);
  }
  for (size_t i = scenes.size(); i > 1; --i) std::swap(scenes[i - 1], scenes[random.below(i)]);
  scenes.resize(std::min(scenes.size(), items));
  return scenes;
}

/// From half to twice the default; of a default of 0 anything.
Settings drawn_settings(const SceneRecipe& scene, Random& random) {
  Settings settings;
  for (const Parameter& p : scene.parameters) {
    if (p.type != Parameter::Type::integer && p.type != Parameter::Type::floating) continue;
    const double low = std::max(p.min, 0.5 * p.initial), high = p.initial > 0 ? std::min(p.max, 2 * p.initial) : p.max;
    const double value = random.uniform(low, high);
    settings.emplace_back(p.name, p.type == Parameter::Type::integer ? fmt::format("{}", std::llround(value))
                                                                     : fmt::format("{:.4g}", value));
  }
  return settings;
}

/// A camera and the radius that suits it. False if it sees too little.
bool place(ItemRecipe& item, const Tracer& tracer, Random& random) {
  const std::optional<SceneCamera> camera = random_camera(tracer, random);
  const double pixels_across = random.of_any_size(least_pixels, most_pixels) * item.width / 640;
  if (!camera) return false;
  CaptureOptions small{.width = item.width / 4, .height = item.height / 4};
  small.planes = {"depth"};
  small.views = {{"", camera_for(*camera, small.width, small.height), {}}};
  const Frame frame = capture(tracer, small).frame;
  const auto pixels = pixels_at_median_depth(frame);
  if (!pixels) return false;
  item.radius = std::round(1e3 * pixels_across / (4 * *pixels)) / 1e3;
  item.placed = *camera;
  return item.radius > 0 && shows_enough(surface_shares(frame.views[0].planes.at("depth").channels[0], item.radius));
}

ItemRecipe drawn_item(const ItemRecipe& from, Random random) {
  ItemRecipe item = from;
  item.name = "seeded-" + from.scene;
  item.camera = "";
  item.settings = drawn_settings(*find_builtin_scene(from.scene), random);
  for (TruthRecipe& truth : item.truths) {
    truth.rays *= 2;
    truth.best_error.reset();
  }
  const Scene scene = load_scene(item.scene, item.settings);
  const Tracer tracer(scene, Tracing::reproducible);
  for (int trial = 0; trial < most_trials; ++trial) {
    if (place(item, tracer, random)) return item;
  }
  throw Error("{}: none of {} random cameras sees enough of it; another {} may", item.scene, most_trials,
              option("seed"));
}

}  // namespace

Recipe seeded_recipe(const Recipe& from, uint64_t seed) {
  Recipe recipe = from;
  recipe.items.clear();
  recipe.hashes.clear();
  Random random(seed);
  uint64_t number = 0;
  for (const ItemRecipe* item : drawn_scenes(from, random))
    recipe.items.push_back(drawn_item(*item, Random(seed, ++number)));
  return recipe;
}

}  // namespace gloam::sets
