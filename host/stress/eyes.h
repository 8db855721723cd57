// Frames with two views of one world, in closed form.
#pragma once

#include <array>
#include <functional>

#include "stress/frames.h"

namespace gloam::stress {

/// A camera in the world.
struct Eye {
  Shot shot;
  Pose pose;
};

/// An eye at a position, turned about the upright axis; degrees, positive to the left.
Eye eye_at(const Shot& shot, const glm::dvec3& position, double turned = 0);

/// AO as a function of world position, painted onto surfaces.
using Paint = std::function<double(const glm::dvec3& world)>;

/// Depth, normals and painted `ao` of two views, "left" and "right", of a scene in world space. Background has the AO 1.
Frame shoot_pair(const std::array<Eye, 2>& eyes, const Scene& world, const Paint& paint);

/// A scene in world space, as one eye sees it.
Scene seen_by(const Pose& pose, const Scene& world);

/// Moves the data window of a frame.
void move_window(Frame& frame, int x, int y);

}  // namespace gloam::stress
