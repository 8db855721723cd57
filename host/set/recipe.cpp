#include "set/recipe.h"

#include <algorithm>

#include "base/json_object.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "scene/fingerprint.h"
#include "scene/reference_kinds.h"
#include "set/hard_frames.h"
#include "set/manifest.h"
#include "set/set_files.h"

namespace gloam::sets {
namespace {

/// An object of texts, in the order of its keys.
std::vector<std::pair<std::string, std::string>> texts_by_name(const JsonObject& fields, const char* key) {
  std::vector<std::pair<std::string, std::string>> all;
  const JsonObject texts = fields.object_if(key);
  for (const auto& [name, value] : texts.json().items()) all.emplace_back(name, texts.text(name));
  return all;
}

TruthRecipe truth_of(const JsonObject& fields) {
  fields.check_keys({"effect", "rays", "best_error"});
  TruthRecipe truth;
  truth.effect = fields.text("effect");
  if (!contains(reference_names(), truth.effect)) fields.refuse("effect", "there are " + enumerate(reference_names()));
  truth.rays = fields.whole("rays", 0, 1 << 24);
  truth.best_error = fields.number_if("best_error");
  return truth;
}

void read_sequence(ItemRecipe& item, const JsonObject& fields, const SceneRecipe& scene) {
  item.shot = fields.text("shot");
  item.frames = fields.wholes("frames", 1);
  const auto shot = std::find_if(scene.shots.begin(), scene.shots.end(),
                                 [&](const ShotRecipe& known) { return known.name == item.shot; });
  if (shot == scene.shots.end()) fields.refuse("shot", "the scene has none of that name (gloam list shots)");
  if (item.frames.empty() || item.frames.back() > shot->frames)
    fields.refuse("frames", fmt::format("the shot has frames from 1 to {}", shot->frames));
}

void read_scene(ItemRecipe& item, const JsonObject& fields) {
  item.scene = fields.text("scene");
  const SceneRecipe* scene = find_builtin_scene(item.scene);
  if (!scene) fields.refuse("scene", "it must be a built-in scene (gloam list scenes)");
  for (auto& [name, value] : texts_by_name(fields, "settings")) item.settings.emplace_back(name, value);
  item.camera = fields.text_if("camera");
  item.with_light = fields.find("light") != nullptr;
  if (item.kind == "sequence") read_sequence(item, fields, *scene);
  if (item.kind == "display") item.display = fields.text("display");
  if (item.kind == "display" && display_text(item.display).empty())
    fields.refuse("display", "it must be a file of data/displays, without .json");
  if (item.kind != "eyes") return;
  const JsonObject eyes = fields.object("eyes");
  item.eyes = StereoRig{eyes.number("distance")};
  item.eyes->convergence = eyes.number_if("convergence");
}

ItemRecipe item_of(const JsonObject& fields, const std::vector<int>& usual_size) {
  fields.check_keys({"name", "kind", "size", "radius", "light", "truths", "scene", "settings", "camera", "shot",
                     "frames", "eyes", "display", "hard"});
  ItemRecipe item;
  item.name = fields.text("name");
  item.kind = fields.text("kind");
  if (!contains(item_kinds(), item.kind)) fields.refuse("kind", "there are " + enumerate(item_kinds()));
  const std::vector<int> size = fields.find("size") ? fields.wholes("size", 1, 1 << 16) : usual_size;
  if (size.size() != 2) fields.refuse("size", "it must be [width, height]");
  item.width = size[0], item.height = size[1];
  item.radius = fields.number("radius");
  if (!(item.radius > 0)) fields.refuse("radius", "more than 0 is allowed");
  for (const JsonObject& truth : fields.objects("truths")) item.truths.push_back(truth_of(truth));
  if (item.kind != "hard") {
    read_scene(item, fields);
    return item;
  }
  item.hard = fields.text("hard");
  if (!contains(hard_frame_names(), item.hard)) fields.refuse("hard", "there are " + enumerate(hard_frame_names()));
  return item;
}

std::vector<Recipe> all_recipes() {
  std::vector<Recipe> all;
  for (const auto& [file, text] : set_files()) {
    if (!file.starts_with("sets/")) continue;
    all.push_back(recipe_of(text, file));
  }
  return all;
}

/// frames/walk.0005.exr
std::vector<std::string> numbered(const std::string& stem, const ItemRecipe& item) {
  if (item.frames.empty()) return {stem + ".exr"};
  std::vector<std::string> files;
  for (const int frame : item.frames) files.push_back(fmt::format("{}.{:04}.exr", stem, frame));
  return files;
}

}  // namespace

std::string display_text(const std::string& name) {
  const auto found = set_files().find("displays/" + name + ".json");
  return found == set_files().end() ? "" : found->second;
}

Recipe recipe_of(const std::string& text, const std::string& name) {
  const nlohmann::ordered_json document = json_of_text(text, name);
  const JsonObject fields(document, {name});
  fields.check_keys({"set", "summary", "licence", "size", "layers", "frozen_with", "items", "hashes"});
  Recipe recipe;
  recipe.name = fields.text("set");
  recipe.summary = fields.text("summary");
  recipe.licence = fields.text("licence");
  recipe.layers = fields.whole("layers", 0, 64);
  recipe.frozen_with = fields.text_if("frozen_with");
  const std::vector<int> size = fields.wholes("size", 1, 1 << 16);
  for (const JsonObject& item : fields.objects("items")) recipe.items.push_back(item_of(item, size));
  for (auto& [file, hash] : texts_by_name(fields, "hashes")) recipe.hashes[file] = hash;
  return recipe;
}

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = all_recipes();
  return all;
}

const Recipe* recipe_named(const std::string& name) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.name == name) return &recipe;
  }
  return nullptr;
}

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) names.push_back(recipe.name);
  return names;
}

const Recipe& find_recipe(const std::string& name) {
  if (const Recipe* recipe = recipe_named(name)) return *recipe;
  const std::vector<std::string> names = recipe_names();
  throw UsageError("no set '{}'{}; there are {} (gloam set list)", name, suggestion(name, names), enumerate(names));
}

std::vector<const ItemRecipe*> chosen_items(const Recipe& recipe, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const ItemRecipe& item : recipe.items) known.push_back(item.name);
  for (const std::string& name : names) {
    if (!contains(known, name))
      throw UsageError("{}: {} has no such item{} (gloam set list {})", option("only", name), recipe.name,
                       suggestion(name, known), recipe.name);
  }
  std::vector<const ItemRecipe*> chosen;
  for (const ItemRecipe& item : recipe.items) {
    if (names.empty() || contains(names, item.name)) chosen.push_back(&item);
  }
  return chosen;
}

std::vector<std::string> frame_files(const ItemRecipe& item) { return numbered("frames/" + item.name, item); }

std::vector<std::string> truth_files(const ItemRecipe& item, const std::string& effect) {
  return numbered("truths/" + item.name + "_" + effect, item);
}

std::string identity_of(const Recipe& recipe, const ItemRecipe& item) {
  Fingerprint print;
  const auto add = [&](const auto&... values) { (print.add(values), ...); };
  add(item.kind, item.scene, item.camera, item.shot, item.display, item.hard, item.frames, item.radius, item.width,
      item.height, recipe.layers, item.with_light);
  for (const auto& [name, value] : item.settings) add(name, value);
  if (item.eyes) add(item.eyes->interpupillary_distance, item.eyes->convergence.value_or(0));
  if (item.placed) add(item.placed->pose.position, item.placed->pose.world_to_view, item.placed->fov_degrees);
  return fmt::format("{} {} {}", recipe.name, item.name, print.text());
}

std::string class_of(const ItemRecipe& item) {
  const SceneRecipe* scene = find_builtin_scene(item.scene);
  return scene ? scene->kind : "flat";
}

}  // namespace gloam::sets
