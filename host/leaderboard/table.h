// Methods over the items of a set: one table for each effect and each choice of items.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "leaderboard/results.h"

namespace gloam::leaderboard {

using report::Number;
using report::Row;

/// Figures of a row, in this order wherever they are listed.
enum Figure {
  error,
  bias,
  ssim,
  flip,
  ratio,
  flicker,
  eyes,
  fit_error,
  fit_ssim,
  fit_flip,
  stated_ms,
  whole_ratio,
  figure_count
};
using Figures = std::array<Number, figure_count>;
/// "error", "bias", ...
const std::array<const char*, figure_count>& figure_names();

/// One thing to measure on, with one effect.
struct Item {
  std::string name, kind, item_class;
  Number width, height, radius, truth_noise;
  double white = 1;
  size_t file = 0;          ///< of the truth's picture
  std::string truth_image;  ///< path below that file's folder; empty: none
};

/// A technique with a preset in a variant on a device, or a submitted method.
struct Entry {
  std::string technique, preset, variant;
  std::string device, driver;  ///< that measured it; of a submitted method what its authors state
  bool is_submitted = false;
  report::Reads reads;
  std::vector<std::pair<size_t, const Row*>> rows;  ///< by item
  std::optional<HeldCases> stability;
};

/// An entry over chosen items.
struct TableRow {
  size_t entry = 0;
  size_t items = 0;  ///< of the choice that it has an error on
  Figures means;     ///< only where it was measured on all items that any entry was measured on
};

/// Items to take means over.
struct Choice {
  std::string what, name;     ///< "all", ""; "kind", "sequence"; "class", "thin"
  std::vector<size_t> items;  ///< on which any entry has an error
  std::vector<TableRow> rows;
};

struct EffectTable {
  std::string effect;
  std::vector<Item> items;
  std::vector<Entry> entries;
  std::vector<Choice> choices;
};

Figures figures_of(const Row& row);

/// The tables of a board, ambient occlusion first. They point into `results`. Throws Error for two files that hold the same row, and
/// for an item that differs between files.
std::vector<EffectTable> tables_of(const Board& board, const Results& results);

}  // namespace gloam::leaderboard
