// A second camera beside a frame's own, turned to the side: surfaces that the first camera sees edge-on, it sees from the front
// (Vermeer, Scandolo, Eisemann 2021, section 3.4).
#pragma once

#include <optional>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// Range of the depths that a view shows, scene units: the 2nd, 50th and 98th percentile over its surfaces, so that a few pixels
/// next to the eye or at the horizon do not count.
struct VisibleDepths {
  double nearest = 0, median = 0, farthest = 0;
};

/// None if the view shows only background.
std::optional<VisibleDepths> visible_depths(const Channel& depth);

/// A camera turned by `degrees` (-90 to 90) about the upright line of the image through the pivot: the point of the first camera's
/// axis at the median depth. Positive: it is to the right of the first. It looks at the pivot.
///
/// Its image, of the same size and pixel shape, holds all of the first camera's frustum between the nearest and the farthest
/// visible depth, plus one per cent. Its principal point is off the middle as far as that requires. A perspective camera is as
/// far from the pivot as the first, or farther if a border of the image would lie over 60 degrees off its axis (120 degrees of
/// view); an orthographic one is farther if a part of that frustum would lie behind it. It has neither a near nor a far plane.
/// The first camera needs a pose.
Camera secondary_camera(const Camera& first, int width, int height, const VisibleDepths& depths, double degrees);

}  // namespace gloam
