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

  /// Computes a plan on few pixels and takes its planes that belong to a picture. `true_per_seen`: how much more the effect changes the
  /// true picture than these planes do. Throws as `run` does.
  void look(const Plan& plan, double true_per_seen, Device& device, const RunOptions& options);

  /// Planes of the picture that are known, sorted.
  const std::vector<std::string>& planes() const { return planes_; }
  /// RMS over surfaces of the expected true picture's colour: of all channels.
  double rms() const;
  /// RMS difference between the picture of these planes alone, as they were seen, and the expected true picture. Errors of planes that
  /// have one sign, such as too little light from what the image does not show, are in it. Kept: a choice asks again and again.
  double loss_with(const std::vector<std::string>& planes) const;
  /// RMS change of the expected true picture by these planes.
  double change_by(const std::vector<std::string>& planes) const;
  /// For each pixel of the glance, how far the expected true picture changes by these planes, in shares of its RMS.
  Plane changes_by(const std::vector<std::string>& planes, const std::string& view) const;
  /// Device time so far.
  double ms() const { return ms_; }
  /// The frame's planes on few pixels.
  const Frame& small() const { return small_; }

 private:
  Frame picture_of(const Frame& parts, const std::vector<std::string>& planes) const;
  double rms_between(const Frame& a, const Frame* b) const;
  std::vector<std::string> without(const std::vector<std::string>& planes) const;

  ComposeOptions how_;
  Frame small_;     ///< all planes of the frame
  Frame parts_;     ///< planes of effects, as they were seen
  Frame expected_;  ///< the same, scaled to what the true ones change
  Frame whole_;     ///< the expected true picture
  std::vector<std::string> planes_;
  mutable std::map<std::vector<std::string>, double> losses_;  ///< by planes
  double ms_ = 0;
};

}  // namespace gloam
