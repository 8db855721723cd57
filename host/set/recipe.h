// What a set is made of: data/sets/NAME.json, or drawn from a seed (seeded.h).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/parameters.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/stereo_cameras.h"

namespace gloam::sets {

struct TruthRecipe {
  std::string effect;  ///< a plane of `gloam reference`
  int rays = 0;        ///< per pixel; 0: a closed form
  std::optional<double> best_error;
};

struct ItemRecipe {
  std::string name, kind;
  int width = 0, height = 0;
  double radius = 0;
  bool with_light = false;  ///< colour and normal of each peeled layer too
  std::vector<TruthRecipe> truths;

  // All kinds but hard:
  std::string scene;                  ///< built in
  Settings settings;                  ///< of the scene
  std::string camera;                 ///< one of the scene's; empty: the first
  std::optional<SceneCamera> placed;  ///< another camera, of a seeded part
  std::string shot;                   ///< of a sequence
  std::vector<int> frames;            ///< likewise
  std::optional<StereoRig> eyes;
  std::string display;  ///< a file of data/displays without .json

  std::string hard;  ///< one of `hard_frames`; its radius and size are those of the item
};

struct Recipe {
  std::string name, summary, licence;
  int layers = 8;  ///< peeled layers per pixel
  std::vector<ItemRecipe> items;
  std::map<std::string, std::string> hashes;  ///< frozen, by file; without one a file is not frozen yet
  std::string frozen_with;                    ///< version and commit that made the hashes
};

/// Those of data/sets/, sorted by name.
const std::vector<Recipe>& recipes();
std::vector<std::string> recipe_names();
/// nullptr if there is none.
const Recipe* recipe_named(const std::string& name);
/// Throws UsageError for an unknown name, with the nearest one.
const Recipe& find_recipe(const std::string& name);

/// Parses and checks a recipe. Throws Error that begins with `name` and names the field.
Recipe recipe_of(const std::string& text, const std::string& name);

/// The names of items that a user chose, checked; all for an empty text. Throws UsageError for an unknown one.
std::vector<const ItemRecipe*> chosen_items(const Recipe& recipe, const std::vector<std::string>& names);

/// The files of an item, relative to the set's folder, in order of its frames.
std::vector<std::string> frame_files(const ItemRecipe& item);
std::vector<std::string> truth_files(const ItemRecipe& item, const std::string& effect);

/// Identifies what a file of the item is made of, so that a file of another recipe is made again.
std::string identity_of(const Recipe& recipe, const ItemRecipe& item);

/// The kind of scene ("architecture"); of a hard frame "flat".
std::string class_of(const ItemRecipe& item);

}  // namespace gloam::sets
