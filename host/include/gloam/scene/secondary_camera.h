// A second camera beside a frame's own, turned to the side: it sees from the front what the first sees edge-on
// (Vermeer, Scandolo, Eisemann 2021, section 3.4).
#pragma once

#include <optional>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Between which depths lies what a view shows, scene units: the 2nd, 50th and 98th percentile over its surfaces, so that
/// a few pixels next to the eye or at the horizon do not count.
struct VisibleDepths {
  double nearest = 0, median = 0, farthest = 0;
};

/// None where the view shows background alone.
std::optional<VisibleDepths> visible_depths(const Channel& depth);

/// A camera turned by `degrees` (-90 to 90) about the upright line of the image through the pivot: the point of the first
/// camera's axis at the median depth. Positive: it stands to the right. It looks at the pivot.
///
/// Its image, of the same number of pixels and the same shape of pixel, holds all of the first camera's frustum between
/// the nearest and the farthest visible depth, with a hundredth to spare. The principal point is off the middle as far as
/// that needs. A perspective camera stands as far from the pivot as the first, or farther where a border of the image would
/// lie over 60 degrees off its axis (120 degrees of view); an orthographic one farther where a part of that frustum would
/// lie behind it. Nothing clips: neither near nor far. The first camera needs a pose.
Camera secondary_camera(const Camera& first, int width, int height, const VisibleDepths& depths, double degrees);

}  // namespace gloam
