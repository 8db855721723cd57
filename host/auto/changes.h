// Changes of a picture by each of several planes, pixel by pixel.
#pragma once

#include <string>
#include <vector>

#include "gloam/composition.h"
#include "gloam/frame.h"
#include "planner/picture_model.h"

namespace gloam {

/// One of a picture's changes: for each view and channel of its colour an image, 0 on the background and where it is not finite.
struct Change {
  std::string name;
  std::vector<Channel> channels;
};

/// A frame of these planes alone.
Frame with_planes(const Frame& frame, const std::vector<std::string>& planes);

/// The picture of a frame and of these planes.
Frame composed(const Frame& frame, const Frame& parts, const std::vector<std::string>& planes,
               const ComposeOptions& how);

/// By each of these planes alone, against the picture without any, and of what the image does not show, as far as the frame has what tells of
/// it (planner/picture_model.h). `frame`: with its colour and depth.
std::vector<Change> changes_of(const Frame& frame, const Frame& parts, const std::vector<std::string>& planes,
                               const ComposeOptions& how);

/// Products of changes, and what every second pixel of every second row tells of the others.
SeenChanges seen_in(const std::vector<Change>& changes, const Frame& frame);

/// Of a picture's colour, over surfaces and channels.
double mean_square(const Frame& picture);

}  // namespace gloam
