#include "shot/cuts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gloam/error.h"

namespace gloam {
namespace {

/// A cut is this many times as far per frame as what is usual beside it, at least.
constexpr double least_ratio = 5;
constexpr double least_turn = 20 * std::numbers::pi / 180;
/// Steps on either side that tell what is usual there.
constexpr size_t steps_beside = 4;

/// From one frame to the next: what is usual is compared per frame, as frames may be left out.
struct Step {
  int to = 0;  ///< the frame
  double distance = 0, angle = 0, frames = 1;
};

double angle_between(const glm::dmat3& a, const glm::dmat3& b) {
  const glm::dmat3 turn = a * glm::transpose(b);
  return std::acos(std::clamp((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2, -1.0, 1.0));
}

std::vector<Step> steps_of(const std::vector<FramePose>& poses) {
  std::vector<Step> steps;
  for (size_t i = 1; i < poses.size(); ++i) {
    if (!poses[i].pose || !poses[i - 1].pose) continue;
    const Pose &before = *poses[i - 1].pose, &now = *poses[i].pose;
    steps.push_back({poses[i].frame, glm::distance(before.position, now.position),
                     angle_between(before.world_to_view, now.world_to_view),
                     double(std::max(1, poses[i].frame - poses[i - 1].frame))});
  }
  return steps;
}

/// The lower median per frame of some steps, so that one jump among them is not taken for usual; 0 of none.
double usual(const std::vector<Step>& steps, size_t begin, size_t end, double Step::*measure) {
  std::vector<double> values;
  for (size_t i = begin; i < end; ++i) values.push_back(steps[i].*measure / steps[i].frames);
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool jumps(const std::vector<Step>& steps, size_t i, double Step::*measure, double least) {
  const size_t first = i > steps_beside ? i - steps_beside : 0, last = std::min(steps.size(), i + 1 + steps_beside);
  const double beside = std::max(usual(steps, first, i, measure), usual(steps, i + 1, last, measure));
  return steps[i].*measure > least && steps[i].*measure / steps[i].frames > least_ratio * beside;
}

}  // namespace

std::vector<int> cuts_in(const std::vector<FramePose>& poses, double radius) {
  const std::vector<Step> steps = steps_of(poses);
  std::vector<int> cuts;
  // A single step has nothing beside it that tells what is usual.
  for (size_t i = 0; i < steps.size() && steps.size() > 1; ++i)
    if (jumps(steps, i, &Step::distance, radius) || jumps(steps, i, &Step::angle, least_turn))
      cuts.push_back(steps[i].to);
  return cuts;
}

std::vector<FramePose> poses_of(const SequenceFiles& shot) {
  std::vector<FramePose> poses;
  for (const SequenceFrame& frame : shot.frames()) {
    if (frame.source != frame.number) continue;  // held: it shows what the frame before it shows
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
