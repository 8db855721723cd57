// A glance: what effects change in the picture, from few of the frame's pixels.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "auto/choice.h"
#include "gloam/composition.h"
#include "gloam/device.h"
#include "gloam/frame.h"
#include "gloam/plan.h"
#include "gloam/run.h"
#include "planner/picture_model.h"

namespace gloam {

/// Pixels of the frame per pixel of a glance, along each axis: 4, fewer for small frames.
int scale_of_glance(const Frame& frame);

/// The frame's colour on few pixels, and the planes of effects as computed there. Works on frames with color only.
class Glance {
 public:
  /// `frame`: normalised, with the planes that effects and the picture need.
  Glance(const Frame& frame, ComposeOptions how);

  /// Computes plans on few pixels and takes their planes that belong to a picture; once. Throws as `run` does.
  void look(const std::vector<Plan>& plans, Device& device, const RunOptions& options);

  /// Planes of the picture that are known, sorted.
  const std::vector<std::string>& planes() const { return planes_; }
  /// RMS over surfaces of the picture of all that is known: of all channels.
  double rms() const { return rms_; }
  /// What was seen of the changes by each plane alone.
  const SeenChanges& seen() const { return seen_; }
  /// What is expected of these changes and of the true picture.
  const PictureModel& model() const { return model_; }
  /// RMS change of the picture of everything by an effect's planes, as its best option is expected to make it.
  double change_by(const std::vector<std::string>& planes) const;
  /// For each pixel of the glance, how far these planes change the picture, in shares of its RMS.
  Plane changes_by(const std::vector<std::string>& planes, const std::string& view) const;
  /// Of planes that are made, those that the picture uses. Kept: a choice asks again and again.
  const std::vector<std::string>& used(const std::vector<std::string>& made) const;
  /// The same as a function, for as long as the glance lives.
  UsedAmong uses() const {
    return [this](const std::vector<std::string>& made) { return used(made); };
  }
  /// Share of tiles of 4 x 4 pixels of the glance where a plane is not as where nothing is.
  double share_of(const std::string& plane) const;
  /// Device time so far.
  double ms() const { return ms_; }
  /// The planes of effects, as they were seen.
  const Frame& parts() const { return parts_; }
  /// The frame's planes on few pixels.
  const Frame& small() const { return small_; }

  /// The picture of planes that are known, on few pixels.
  Frame picture_of(const std::vector<std::string>& planes) const;

 private:
  void take_planes_of(const Plan& plan, Device& device, const RunOptions& options);

  ComposeOptions how_;
  Frame small_;  ///< all planes of the frame
  Frame parts_;  ///< planes of effects, as they were seen
  std::vector<std::string> planes_;
  Frame whole_;  ///< the picture of all of these
  double rms_ = 0;
  SeenChanges seen_;
  PictureModel model_;
  mutable std::map<std::vector<std::string>, std::vector<std::string>> used_;  ///< by planes that are made
  double ms_ = 0;
};

}  // namespace gloam
