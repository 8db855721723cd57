// A file read by rows, for figures of a frame that is never in memory as a whole.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exr/conversion.h"
#include "exr/file.h"
#include "exr/file_cameras.h"
#include "gloam/frame.h"

namespace gloam {

/// Facts about the whole image that are needed before its rows can be used.
struct Survey {
  Frame frame;  ///< the depth alone, if needed, and all assumptions
  Conventions conventions;
  std::map<std::string, std::optional<NormalForm>> normal_forms;  ///< by view; none: the normals are unusable
};

/// Planes that a survey decodes whole: the depth, and alpha if the meaning of the depth may depend on it.
std::vector<std::string> planes_surveyed_whole(const std::vector<std::string>& asked);

/// Planes that are read by rows: all but the depth.
std::vector<std::string> planes_by_rows(const std::vector<std::string>& asked);

/// Rows [first, last) of the window, as stored.
Frame decode_rows(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& planes, int first,
                  int last);

/// `frame`: with `planes_surveyed_whole`, decoded.
Survey survey_planes(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& asked,
                     Frame frame);

/// Brings decoded rows to gloam's conventions.
void convert_rows(const ExrFile& file, const FileCameras& cameras,
                  const std::map<std::string, std::optional<NormalForm>>& normal_forms, Frame& rows);

}  // namespace gloam
