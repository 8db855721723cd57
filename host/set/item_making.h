// Makes the frames and the truths of one item.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "set/item_scene.h"
#include "set/manifest.h"
#include "set/recipe.h"

namespace gloam::sets {

/// Work to make an item, in rays, about: for shares of a progress bar.
double work_in(const ItemRecipe& item);

class ItemMaker {
 public:
  using Progress = std::function<void(const std::string& what, double share)>;
  ItemMaker(const Recipe& recipe, const ItemRecipe& item, const std::filesystem::path& folder, Progress progress);

  /// Makes the files that are missing, or that hold something else.
  SetItem make();
  int made() const { return made_; }
  int kept() const { return kept_; }

 private:
  SetFile frame_file(size_t i);
  SetFile truth_file(size_t i, const TruthRecipe& truth);
  void trace(size_t i, const TruthRecipe& truth, const std::filesystem::path& file, const std::string& identity);
  void make_hard(SetItem& item);
  std::string kept_hash(const std::string& file, const std::string& identity);
  SetTruth made_truth(const TruthRecipe& truth);
  int number(size_t i) const { return item_.frames.empty() ? 0 : item_.frames[i]; }
  void tell(const std::string& what, double share) const;

  const Recipe& recipe_;
  const ItemRecipe& item_;
  std::filesystem::path folder_;
  Progress progress_;
  ItemScene scene_;
  int made_ = 0, kept_ = 0;
  double done_ = 0;  ///< of `work_in`
};

}  // namespace gloam::sets
