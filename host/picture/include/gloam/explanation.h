// The picture of `gloam auto`: which effects a frame calls for, where, and why.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/composition.h"
#include "gloam/frame.h"

namespace gloam {

/// What `gloam auto` has found about one effect: a row of the table, and a panel.
struct Explanation {
  enum class Wanted { yes, no, impossible };

  std::string effect;     ///< "ambient occlusion"
  std::string technique;  ///< what runs for it, with its settings: "evidence, medium, half resolution"; may be empty
  Wanted wanted = Wanted::no;
  std::string where;  ///< share of the image that calls for it: "everywhere", "34 %"; "-" or empty: nowhere
  std::string why;    ///< a sentence
  std::string saved;  ///< time: "3.2 of 8.1 ms"; may be empty
  std::string lost;   ///< error of the picture: ".0021 RMSE of the picture"; may be empty
  std::string says;   ///< what it changes, what that takes, and what the choice misses: a sentence; may be empty
  /// Above 0 where the effect is called for; one value per pixel or square tile, whose side is a power of two. Null: unknown.
  const Plane* cells = nullptr;
  /// Computed everywhere, as so much of the image calls for it that a mask would not pay. Without `cells`, all of it does.
  bool is_everywhere = false;
  /// How much the effect changes the picture, 0 or more; one value per pixel or square tile. Drawn as the strength of the tint, on
  /// one scale for all effects. Null: unknown.
  const Plane* change = nullptr;
  /// Of the picture the part that the effect changes most. Null: unknown.
  const PicturePart* part = nullptr;
};

/// What the picture says besides the effects.
struct ExplanationText {
  std::string title;               ///< the file's name
  std::string sentence;            ///< below the title; may be empty
  std::string totals;              ///< sentences below the table; may be empty
  const Plane* picture = nullptr;  ///< the view's colour with all that is computed; null: unknown
};

/// Draws a view's colours (its surfaces lit from the eye, if it has none), and beside them a panel for each effect that is wanted or
/// has `cells`: the same in pale grey, with a tint on surfaces where the effect is called for. Where the picture is known, each effect has a row:
/// this panel, and the outlined part of the picture without the effect and with it. Below the panels, a table of all effects. Text is broken
/// between words. At most 2000 pixels wide. PNG, written atomically. Throws Error for a view without depth.
void write_explanation(const std::filesystem::path& path, const View& view,
                       const std::vector<Explanation>& explanations, const ExplanationText& text = {});

}  // namespace gloam
