// A frame of files from its plan to its result: alone, or in a shot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/frame_files.h"
#include "gloam/plan.h"
#include "gloam/radius.h"
#include "shot/colour_layer.h"

namespace gloam {

/// A frame that is open, with the plan for it.
struct PlannedFrame {
  FrameFiles files;
  PlanRequest request;
  Plan plan;
  std::vector<std::string> planes;    ///< to decode: what the plan reads, and depth if it is carried over
  std::optional<ColourLayer> colour;  ///< for a composite
};

/// Plans. Of a request that goes on over time and a frame without a history, the caller adds the planes of one. The file's depth is
/// decoded too if it is carried over to the output.
PlannedFrame planned_frame(FrameFiles files, const PlanRequest& request, bool carries_depth);

/// Plans anew after a change of the request.
void plan_again(PlannedFrame& planned, bool carries_depth);

/// Memory for the colour of a composite, if there is one.
unsigned long long bytes_of_colour(const PlannedFrame& planned);

/// Plans the first output alone, with the extras asked for, unless outputs are chosen.
void keep_first_output(PlannedFrame& planned, bool carries_depth);

/// Fits the plan to the planes as decoded: some may have turned out to be of no use, and the default radius is made from the
/// depth. Returns the radius, if the plan has one. Appends sentences to `notes`.
std::optional<Radius> settle(PlannedFrame& planned, const Frame& frame, std::vector<std::string>& notes);

/// A sentence where a history tells nothing about a frame; else none. `who`: "frame 7: shows next to nothing that the frame before
/// showed", for that case.
std::vector<std::string> warning_about_history(const Frame& frame, const Frame& result, const std::string& who);

/// What an output has besides the planes computed.
struct Carried {
  /// `compare` knows the background by the depth, and `compare --stereo` the edges by the normals of two views.
  bool depth = true;
  bool cameras = true;
};

/// Moves planes, and leaves out cameras that are not wanted.
void carry_over(Frame& from, Frame& to, const Carried& carried);

}  // namespace gloam
