// A plane of a view as it is drawn: its style, by the meaning of its values, and the numbers that are drawn.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

#include "gloam/frame.h"
#include "picture/picture.h"

namespace gloam {

/// How a plane is coloured.
enum class PictureStyle {
  depth,      ///< logarithmic scale that all depths of the picture share; near is bright
  direction,  ///< 0.5 + 0.5 n as red, green, blue
  colour,     ///< through sRGB
  share,      ///< grey, 0 to 1
  identity,   ///< a colour of its own for each value
  count,      ///< colour map from the least to the most
  position,   ///< each axis scaled to its range, as red, green, blue
  motion,     ///< hue by direction, brightness by length
  scalar,     ///< grey, scaled to its range
};

/// One plane of one view, as it is drawn.
struct Tile {
  const View* view;
  const Plane* plane;
  PictureStyle style;
  const Channel* background = nullptr;  ///< depth; the tile is hatched where it is infinite; null: no hatching

  const Layout& layout() const { return plane->channels[0].layout(); }
  bool is_background(int x, int y) const { return background && gloam::is_background(background->at(x, y)); }
};

/// The tile of a plane, by its kind; hatched where the view's depth is infinite, unless background has a value.
Tile tile_of(const View& view, const Plane& plane);

/// The drawn number of a component (for depths, the logarithm); NaN if there is none.
double value_at(const Tile& tile, size_t component, int x, int y);

/// Number of drawn components; one for motion, its length.
size_t components_of(const Tile& tile);

/// Whether all drawn numbers of a pixel have a colour: finite, and positive for depths.
bool is_finite(const Tile& tile, int x, int y);

/// CV_8UC1, 255 on background.
cv::Mat background_mask(const Tile& tile);

/// Identities cannot be averaged.
Sampling sampling_of(const Tile& tile);

}  // namespace gloam
