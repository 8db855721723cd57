// How planes look in the pictures for people: colours by what values mean, one scale for what is to be compared, ranges in
// words.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "picture/picture.h"

namespace gloam {

/// How a plane is coloured.
enum class Look {
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
  Look look;
  const Channel* background = nullptr;  ///< depth that is infinite where the tile is hatched; none: nowhere

  const Layout& layout() const { return plane->channels[0].layout(); }
  bool is_background(int x, int y) const { return background && gloam::is_background(background->at(x, y)); }
};

/// By the plane's kind; hatched where the view's depth is infinite, unless the sky has a value.
Tile tile_of(const View& view, const Plane& plane);

// --- Ranges

/// Of the values that are drawn of one component.
struct Range {
  double low = 0, high = 0;    ///< of all finite values
  double first = 0, last = 0;  ///< ends of the colours
  long long finite = 0;        ///< pixels

  /// 0 to 1; a scale without extent has its middle only.
  double position(double v) const;
};

/// One for each component that is drawn, over tiles of one look and plane.
std::vector<Range> ranges_of(const std::vector<const Tile*>& tiles);

/// Tiles of one key share a scale: all depths, and one plane in several views.
std::string scale_key(const Tile& tile);

using Scales = std::map<std::string, std::vector<Range>>;
Scales scales_of(const std::vector<Tile>& tiles);
/// That of the depths, in logarithms; none where none is drawn.
const Range* depth_scale(const Scales& scales);

// --- Images

/// The plane at full size, CV_8UC3. Values that are not finite are magenta; background is left as it is.
cv::Mat colours_of(const Tile& tile, const std::vector<Range>& scale);

/// CV_8UC1, 255 on background.
cv::Mat background_mask(const Tile& tile);

/// Identities are no numbers to average.
Sampling sampling_of(const Tile& tile);

// --- Words

/// Several ways to say it, the longest first.
using Wordings = std::vector<std::string>;

/// What the values of tiles of one look and plane are: their `own` ranges, and the `scale` that they are drawn on, of more
/// tiles perhaps.
Wordings range_in_words(const std::vector<const Tile*>& tiles, const std::vector<Range>& own,
                        const std::vector<Range>& scale);

/// The longest wording that fits into `width`, else the last, shortened.
std::string fitting(const Wordings& wordings, double width, const Style& style);

/// What stands above the tiles of a sheet.
struct Heading {
  std::string title;
  Wordings facts;                 ///< a line below the title
  const Range* depths = nullptr;  ///< "depth 1.2 [bar] 14" below that, where depths are drawn
  double unit = 1;                ///< scales it
  int margin = 24;                ///< pixels, on either side
};

/// Pixels, to the top of the tiles' captions.
int heading_height(double unit, bool has_depths);

void draw_heading(cv::Mat& canvas, const Heading& heading);

}  // namespace gloam
