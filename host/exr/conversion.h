// Converts the planes of a file to gloam's conventions, with a note for each assumption.
#pragma once

#include <string>
#include <vector>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "exr/normals.h"
#include "gloam/frame.h"
#include "normalise/radiance.h"

namespace gloam {

/// The conventions found for the values of a file, of the view that was converted last.
struct Conventions {
  std::string depth;         ///< as returned by `to_view_depth`; empty before
  std::string normal_space;  ///< "view" or "world"; empty before, and without usable normals
  FoundNormals normals;      ///< of the first view that has any
  FoundDepth read_depth;     ///< of the first view whose depth nothing states

  void take(const std::string& depth_convention);
  void take(const std::optional<NormalForm>& form);
  void take(const Conventions& found);
};

/// The planes asked for and, for the background of normals, depth.
std::vector<std::string> planes_to_decode(const std::vector<std::string>& asked);

/// Adds notes on the assumptions about views, names and cameras, and on views that lack a plane asked for.
void note_assumptions(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& asked,
                      Frame& frame);

/// Converts whole planes. Views without a known camera get one.
void convert_planes(const ExrFile& file, const FileCameras& cameras, Frame& frame, Conventions& conventions);

/// Finishes a converted frame: the background, the length of normals, padding; makes the notes printable.
void finish_frame(const ExrFile& file, Frame& frame);

/// Adds notes on the values counted, and on a header that calls the colour of one of the frame's views other than linear.
void note_light(const ExrFile& file, const LightCounts& counts, Frame& frame);

}  // namespace gloam
