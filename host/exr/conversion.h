// From planes as a file has them to gloam's conventions, with a note for each assumption.
#pragma once

#include <string>
#include <vector>

#include "exr/file.h"
#include "exr/file_cameras.h"
#include "exr/normals.h"
#include "gloam/frame.h"

namespace gloam {

/// How the values of a file were understood: of the view that was converted last.
struct Conventions {
  std::string depth;         ///< as of `to_view_depth`; empty before
  std::string normal_space;  ///< "view" or "world"; empty before, and without usable normals

  void take(const std::string& depth_convention);
  void take(const std::optional<NormalForm>& form);
};

/// The planes asked for and, for the background of normals, depth.
std::vector<std::string> planes_to_decode(const std::vector<std::string>& asked);

/// What was assumed of views, names and cameras, and which views lack what is asked for.
void note_assumptions(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& asked,
                      Frame& frame);

/// Of whole planes. Views get cameras where none is known.
void convert_planes(const ExrFile& file, const FileCameras& cameras, Frame& frame, Conventions& conventions);

/// Of a frame that has been converted: the background, the length of normals, padding; sentences become printable.
void finish_frame(const ExrFile& file, Frame& frame);

}  // namespace gloam
