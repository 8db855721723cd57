// Values of colour and albedo that are no light: counted before they are cleaned. And colour that was made for a display.
#pragma once

#include <bitset>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Sums over pixels. They do not depend on the order of the rows.
struct ColourCounts {
  long long pixels = 0, negative = 0, nonfinite = 0;  ///< `negative`, `nonfinite`: pixels with such a component
  long long surfaces = 0,
            dark_surfaces = 0;  ///< pixels before the background, and those of them without a finite value
  long long outside = 0;        ///< components below 0 or above 1
  /// Some components of each row that lie between 0 and 1, and those of them that an 8-bit picture can have: as k/255, and as the
  /// light for which the sRGB curve has k/255.
  long long tried = 0, steps = 0, steps_of_light = 0;
  std::bitset<256> levels, levels_of_light;  ///< the k found
  /// Of those that lie above 1: all, those that are whole numbers, the greatest, and the last 8 bits of the whole ones.
  long long above_one = 0, whole = 0;
  float greatest = 0;
  std::bitset<256> levels_of_whole;
};

struct AlbedoCounts {
  long long pixels = 0, above_one = 0, negative = 0;  ///< of surfaces, with such a component; NaN counts as negative
};

/// What the planes `color` and `albedo` hold that is no light.
struct LightCounts {
  ColourCounts color;
  AlbedoCounts albedo;

  /// Adds a row of a view's planes, of those that it has. `depth`: of the row, which tells surfaces from the background; null: all are
  /// surfaces. Threads may add rows at the same time.
  void add_row(const View& view, int y, const float* depth);
  /// Adds all rows. `depth`: an image of which they are those from `first_row` on; null as above.
  void add(const View& view, const Plane* depth, int first_row = 0);
  /// One sentence each for what is found and what becomes of it. `judged`: the planes that nobody has chosen, which are called unfit
  /// (frame/unfit.h) if what is found says so.
  std::vector<std::string> notes(const std::vector<std::string>& judged = {}) const;
};

/// Whether values of a colour space, by its name in the list of the Color Interop Forum, are in proportion to light: "lin_rec709_scene".
bool is_linear(const std::string& color_interop_id);

}  // namespace gloam
