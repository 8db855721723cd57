#include "shot/cuts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gloam/error.h"

namespace gloam {
namespace {

/// A cut is this many times as far as the steps beside it, at least.
constexpr double least_ratio = 5;
constexpr double least_turn = 20 * std::numbers::pi / 180;

/// Of one frame to the next, per frame number.
struct Step {
  double distance = 0, angle = 0;
};

double angle_between(const glm::dmat3& a, const glm::dmat3& b) {
  const glm::dmat3 turn = a * glm::transpose(b);
  return std::acos(std::clamp((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2, -1.0, 1.0));
}

std::optional<Step> step_to(const std::vector<FramePose>& poses, size_t i) {
  if (i == 0 || i >= poses.size() || !poses[i].pose || !poses[i - 1].pose) return {};
  const Pose &before = *poses[i - 1].pose, &now = *poses[i].pose;
  const double frames = std::max(1, poses[i].frame - poses[i - 1].frame);
  return Step{glm::distance(before.position, now.position) / frames,
              angle_between(before.world_to_view, now.world_to_view) / frames};
}

bool jumps(double step, double before, double after, double least) {
  return step > least && step > least_ratio * std::max(before, after);
}

}  // namespace

std::vector<int> cuts_in(const std::vector<FramePose>& poses, double radius) {
  std::vector<int> cuts;
  for (size_t i = 1; i < poses.size(); ++i) {
    const std::optional<Step> step = step_to(poses, i);
    if (!step) continue;
    // At the ends of the shot, and next to another jump, one side says nothing.
    const Step before = step_to(poses, i - 1).value_or(Step{}), after = step_to(poses, i + 1).value_or(Step{});
    if (jumps(step->distance, before.distance, after.distance, radius) ||
        jumps(step->angle, before.angle, after.angle, least_turn))
      cuts.push_back(poses[i].frame);
  }
  return cuts;
}

std::vector<FramePose> poses_of(const SequenceFiles& shot) {
  std::vector<FramePose> poses;
  for (const SequenceFrame& frame : shot.frames()) {
    FramePose& found = poses.emplace_back(FramePose{frame.number, {}});
    try {
      const FrameFiles files = shot.open(frame);
      const std::optional<Camera> camera = files.files().front().camera(files.views().front());
      if (camera && camera->pose) found.pose = *camera->pose;
    } catch (const Error&) {
      // Its turn will say what is wrong with it.
    }
  }
  return poses;
}

}  // namespace gloam
