// A glance: what effects change in the picture, from few of the frame's pixels.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/composition.h"
#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// Pixels of the frame per pixel of a glance, along each axis: 4, fewer for small frames.
int scale_of_glance(const Frame& frame);

/// The frame's colour on few pixels, and the planes of effects as computed there. Works on frames with color only.
class Glance {
 public:
  /// `frame`: normalised, with the planes that effects and the picture need.
  Glance(const Frame& frame, ComposeOptions how);

  /// Computes a plan on few pixels and takes its planes that belong to a picture. Throws as `run` does.
  void look(const Plan& plan, Device& device, const RunOptions& options);

  /// Planes of the picture that are known, sorted.
  const std::vector<std::string>& planes() const { return planes_; }
  /// RMS over surfaces of the picture's colour with everything: of all channels.
  double rms() const;
  /// RMS difference between the picture of these planes alone and the picture of all.
  double loss_with(const std::vector<std::string>& planes) const;
  /// RMS difference between the picture of all planes and the one without this plane.
  double loss_without(const std::string& plane) const;
  /// For each pixel of the glance, how far the picture changes without this plane, in shares of the picture's RMS.
  Plane change_by(const std::string& plane, const std::string& view) const;
  /// Device time so far.
  double ms() const { return ms_; }
  int scale() const { return scale_; }
  /// The frame's planes on few pixels, and the planes of effects.
  const Frame& small() const { return small_; }
  const Frame& parts() const { return parts_; }

 private:
  Frame picture_of(const std::vector<std::string>& planes) const;
  double rms_between(const Frame& a, const Frame* b) const;
  std::vector<std::string> without(const std::string& plane) const;

  int scale_;
  ComposeOptions how_;
  Frame small_;  ///< all planes of the frame
  Frame parts_;  ///< planes of effects
  Frame whole_;  ///< the picture of all planes
  std::vector<std::string> planes_;
  double ms_ = 0;
};

}  // namespace gloam
