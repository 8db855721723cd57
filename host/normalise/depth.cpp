#include "normalise/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/background.h"
#include "normalise/depth_by_normals.h"
#include "normalise/depth_encoding.h"
#include "normalise/each_row.h"
#include "normalise/stored_depth.h"

namespace gloam {

namespace {

void ray_row(float* row, const double* squares_x, int width, double square_y) {
  for (int x = 0; x < width; ++x) {
    const float z = float(row[x] / std::sqrt(1 + square_y + squares_x[x]));
    row[x] = z >= nearest_depth ? z : infinity;
  }
}

/// Distance from the eye to planar depth, at pixel centres. +inf stays.
void ray_to_depth(Channel& depth, const Window& window, const Camera& camera) {
  const int width = depth.layout().width;
  std::vector<double> squares_x(static_cast<size_t>(width));
  for (int x = 0; x < width; ++x) {
    const double tangent = (window.x0 + x + 0.5 - camera.cx) / camera.fx;
    squares_x[size_t(x)] = tangent * tangent;
  }
  for_each_row(depth.layout(), [&](int y) {
    const double tangent = (window.y0 + y + 0.5 - camera.cy) / camera.fy;
    ray_row(depth.row(y), squares_x.data(), width, tangent * tangent);
  });
}

/// Map from window depth d to the reciprocal of view depth (perspective) or to view depth (orthographic): a + b d.
struct WindowDepth {
  double a, b;
  float lowest, highest;  ///< d of a surface: lowest <= d <= highest, without the far value
  float background;       ///< --background; NaN: none
};

void perspective_row(float* row, int width, const WindowDepth& map) {
  for (int x = 0; x < width; ++x) {
    const float d = row[x], z = float(1 / (map.a + map.b * d));
    const bool surface =
        (d >= map.lowest) & (d <= map.highest) & (d != map.background) & (z >= nearest_depth) & (z < farthest_depth);
    row[x] = surface ? z : infinity;
  }
}

void orthographic_row(float* row, int width, const WindowDepth& map) {
  for (int x = 0; x < width; ++x) {
    const float d = row[x], z = float(map.a + map.b * d);
    const bool surface =
        (d >= map.lowest) & (d <= map.highest) & (d != map.background) & (z >= nearest_depth) & (z < farthest_depth);
    row[x] = surface ? z : infinity;
  }
}

/// Whether any pixel is without cover.
bool marks_background(const Channel& alpha) {
  for (int y = 0; y < alpha.layout().height; ++y) {
    const float* row = alpha.row(y);
    if (std::find(row, row + alpha.layout().width, 0.0f) != row + alpha.layout().width) return true;
  }
  return false;
}

/// In NDC 0 is the near plane, so only alpha tells a pixel that was never drawn.
void mark_missing(Channel& depth, const Channel& alpha) {
  const int width = depth.layout().width;
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    const float* cover = alpha.row(y);
    for (int x = 0; x < width; ++x) row[x] = ((row[x] == 0) & (cover[x] == 0)) ? infinity : row[x];
  });
}

/// Nothing lies on the near plane itself: a share of pixels there was never drawn, as with a sky that is left at the value of the near plane.
void mark_near_plane(Channel& depth, float near, std::vector<std::string>& assumed) {
  if (const double share = mark_share(depth, near); share > 0)
    assumed.push_back(fmt::format(
        "depth: {:.1f} % of the pixels are {:g}, exactly on the near plane, and taken as background; {} says otherwise",
        100 * share, near, option("background")));
}

/// What is stored, times the scale, plus the offset.
double scaled(float stored, const StatedDepth& stated) {
  return stated.scale.value_or(1) * double(stored) + stated.offset.value_or(0);
}

/// Of all pixels.
void apply_scale(Channel& depth, const StatedDepth& stated) {
  if (!stated.scale && !stated.offset) return;
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    for (int x = 0; x < depth.layout().width; ++x) row[x] = float(scaled(row[x], stated));
  });
}

/// As above, where the result decides what is background; what is stored does so where it is not finite, 1e10 and more, or as stated.
/// A share of zeros is background too: that is how a grey tells that there is nothing.
void shift(Channel& depth, const StatedDepth& stated, std::vector<std::string>& assumed) {
  const Background background = background_of(stated.background, {});
  const double zeros = stated.background ? 0 : mark_share(depth, 0);
  if (zeros > 0)
    assumed.push_back(
        fmt::format("depth: {:.1f} % of the pixels are stored as 0, and taken as background; {} says otherwise",
                    100 * zeros, option("background")));
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    for (int x = 0; x < depth.layout().width; ++x) {
      const bool is_nothing = !(std::abs(row[x]) < background.from) || row[x] == background.value;
      row[x] = is_nothing ? infinity : float(scaled(row[x], stated));
    }
  });
}

/// As above, of lengths whose background is +inf, or of their reciprocals, which become lengths.
void to_lengths(Channel& depth, const StatedDepth& stated) {
  const bool is_inverse = stated.convention == DepthConvention::inverse;
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    for (int x = 0; x < depth.layout().width; ++x) {
      const double value = scaled(row[x], stated), length = is_inverse ? 1 / value : value;
      row[x] = row[x] < infinity && length >= double(nearest_depth) ? float(length) : infinity;
    }
  });
}

/// The map from window depth, checked: near and far are needed; flags override the camera.
WindowDepth window_depth(const Camera& camera, const StatedDepth& stated, std::vector<std::string>& assumed) {
  const bool reversed = stated.convention == DepthConvention::reversed;
  const char* name = reversed ? "reversed" : "ndc";
  const std::optional<double> near = stated.near ? stated.near : camera.near;
  std::optional<double> far = stated.far ? stated.far : camera.far;
  if (!near)
    throw Error("{}: needs the distance of the near plane; give {}, or a camera that has it", option("depth", name),
                option("near"));
  if (!far && reversed && !camera.orthographic) {
    assumed.push_back("depth: the far plane taken as infinite; " + option("far") + " says otherwise");
    far = std::numeric_limits<double>::infinity();
  }
  if (!far)
    throw Error("{}: needs the distance of the far plane; give {}, or a camera that has it", option("depth", name),
                option("far"));
  if (!std::isfinite(*near) || (!camera.orthographic && !(*near > 0)))
    throw Error("{}: near is {:g}; expected a distance > 0", option("depth", name), *near);
  if (!(*far > *near))
    throw Error("{}: far is {:g}; expected more than near, {:g}", option("depth", name), *far, *near);
  if (camera.orthographic && !std::isfinite(*far))
    throw Error("{}: far is infinite; an orthographic camera needs a finite one", option("depth", name));

  const double at_near = camera.orthographic ? *near : 1 / *near, at_far = camera.orthographic ? *far : 1 / *far;
  WindowDepth map;
  map.a = reversed ? at_far : at_near;
  map.b = reversed ? at_near - at_far : at_far - at_near;
  map.lowest = reversed ? std::numeric_limits<float>::denorm_min() : 0.0f;
  map.highest = reversed ? 1.0f : std::nextafter(1.0f, 0.0f);
  map.background = stated.background.value_or(std::numeric_limits<float>::quiet_NaN());
  return map;
}

std::string window_to_depth(Channel& depth, const Channel* alpha, const Camera& camera, const StatedDepth& stated,
                            std::vector<std::string>& assumed) {
  const bool reversed = stated.convention == DepthConvention::reversed;
  const WindowDepth map = window_depth(camera, stated, assumed);
  apply_scale(depth, stated);
  if (alpha && !reversed && marks_background(*alpha))
    mark_missing(depth, *alpha);
  else if (!stated.background)
    mark_near_plane(depth, reversed ? 1.0f : 0.0f, assumed);
  for_each_row(depth.layout(), [&](int y) {
    const auto convert = camera.orthographic ? orthographic_row : perspective_row;
    convert(depth.row(y), depth.layout().width, map);
  });
  return reversed ? "reversed" : "ndc";
}

/// How the normals beside a depth see whole numbers that wrap; nothing without normals, or where an offset or a reciprocal makes lengths.
VoteOnTurns vote_of(const StatedDepth& stated, const Window& window, const Camera& camera,
                    const NormalsBeside* normals) {
  const bool is_ray = stated.convention == DepthConvention::ray;
  const bool is_length =
      is_ray || stated.convention == DepthConvention::z || stated.convention == DepthConvention::automatic;
  if (!normals || !is_length || stated.offset || stated.scale.value_or(1) < 0) return {};
  return [=, &window, &camera](const Channel& depth) {
    const DepthRows rows = rows_of(depth);
    return votes_on_turns(values_of(rows), is_ray ? DepthMeaning::along_ray : DepthMeaning::planar, window, camera,
                          *normals);
  };
}

/// Undoes what is stated of the encoding, or whole numbers that are seen to wrap around. Returns whether there is anything new to `stated`,
/// whose encoding is then one that is undone.
bool settle_encoding(Channel& depth, StatedDepth& stated, const VoteOnTurns& vote, std::vector<std::string>& assumed) {
  if (stated.encoding && *stated.encoding == DepthEncoding()) return false;
  if (stated.encoding) {
    check(*stated.encoding, depth, option("depth-encoding"));
    undo(*stated.encoding, depth, vote);
    stated.encoding = DepthEncoding();
    return true;
  }
  const Wraps wraps = stated.convention == DepthConvention::inverse ? Wraps() : count_wraps(depth);
  const double by_normals = !wraps.is_sure && vote && may_wrap(depth) ? share_of_wrapped(vote(depth)) : 0;
  if (by_normals > 0) {
    undo({.wrapped = true}, depth, vote);
    assumed.push_back(fmt::format(
        "depth: the normals of {:.1f} % of the samples fit whole numbers that went on past 65535 at 0: they are taken "
        "to wrap around, and are unwrapped; {} states that, {} says otherwise",
        100 * by_normals, option("depth-encoding", "wrapped"), option("depth-encoding", "plain")));
    stated.encoding = DepthEncoding();
    return true;
  }
  if (wraps.neighbours == 0) return false;
  if (!wraps.is_sure) {
    assumed.push_back(
        fmt::format("depth: its whole numbers may wrap around: {} neighbours go on past 65535 at 0; {} unwraps them",
                    wraps.neighbours, option("depth-encoding", "wrapped")));
    return false;
  }
  undo({.wrapped = true}, depth, vote);
  assumed.push_back(fmt::format(
      "depth: {} neighbours go on past 65535 at 0: the whole numbers are taken to wrap around, and are unwrapped; {} "
      "states that, {} says otherwise",
      wraps.neighbours, option("depth-encoding", "wrapped"), option("depth-encoding", "plain")));
  stated.encoding = DepthEncoding();
  return true;
}

}  // namespace

std::string to_view_depth(Channel& depth, const Channel* alpha, const Window& window, const Camera& camera,
                          const StatedDepth& stated, std::vector<std::string>& assumed, const NormalsBeside* normals,
                          FoundDepth* told) {
  if (camera.slits && stated.convention != DepthConvention::automatic && stated.convention != DepthConvention::z)
    throw UsageError(
        "{} ray, ndc, reversed and inverse need a single centre of projection; the depth of a display's module is z",
        option("depth"));
  if (stated.scale && !(*stated.scale != 0))
    throw UsageError("{}: every depth would be the same; any number but 0 is allowed", option("depth-scale", "0"));
  StatedDepth decoded = stated;
  if (settle_encoding(depth, decoded, vote_of(stated, window, camera, normals), assumed)) {
    const std::string convention = to_view_depth(depth, alpha, window, camera, decoded, assumed, normals, told);
    if (told && !stated.encoding) *told = {};  // other frames may wrap elsewhere, or not at all
    return convention;
  }
  if (is_window_depth(stated.convention)) return window_to_depth(depth, alpha, camera, stated, assumed);

  const std::optional<double> far = stated.far ? stated.far : camera.far;
  const bool is_mapped = stated.scale || stated.offset || stated.convention == DepthConvention::inverse;
  // With these, signs and zeros are what comes of them, not what is stored.
  const bool is_shifted = stated.offset || stated.scale.value_or(1) < 0;
  if (is_shifted) shift(depth, stated, assumed);
  const StoredDepth found = look_at_depth(
      rows_of(depth), background_of(is_shifted ? std::nullopt : stated.background, is_mapped ? std::nullopt : far),
      stated.background.has_value(), "; " + option("background") + " says otherwise");
  if (stated.convention == DepthConvention::automatic && !is_shifted) {
    std::vector<std::string> notes;
    const ToldDepth read = told_by_surfaces(depth, found, window, camera, stated, normals, notes);
    const std::string convention = to_view_depth(depth, alpha, window, camera, read.read, assumed);
    if (told) *told = {read.read, read.is_told, notes};
    assumed.insert(assumed.end(), notes.begin(), notes.end());
    return convention;
  }
  assumed.insert(assumed.end(), found.notes.begin(), found.notes.end());
  if (stated.near)
    assumed.push_back(fmt::format("depth: {} has no effect; {} and {} need it, and other depth is a distance already",
                                  option("near"), option("depth", "ndc"), option("depth", "reversed")));
  clean_depth(depth, found.sign, found.background);
  if (is_mapped) {
    StatedDepth left = stated;
    if (is_shifted) left.scale = left.offset = std::nullopt;  // done
    to_lengths(depth, left);
    clean_depth(depth, 1, background_of({}, far));
  }
  if (stated.convention == DepthConvention::inverse) {
    if (!stated.scale)
      assumed.push_back(fmt::format(
          "depth: 1 / what is stored is taken for scene units; {} says what it is to be multiplied by, 1 / (baseline x "
          "focal length) of disparities in pixels",
          option("depth-scale")));
    return "inverse";
  }
  if (stated.convention == DepthConvention::ray) {
    if (!camera.orthographic) ray_to_depth(depth, window, camera);
    return "ray";
  }
  if (found.sign < 0) return "negative z";
  if (stated.convention == DepthConvention::automatic)
    assumed.push_back(note_on_planar_depth(found.is_in_unit_interval));
  return "z";
}

}  // namespace gloam
