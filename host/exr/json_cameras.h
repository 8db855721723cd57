// Cameras of the JSON that --camera names or that lies beside an EXR file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"

namespace gloam {

/// An EXR file that is one of two, an eye each.
struct EyeOfPair {
  std::string name;             ///< of the view in the frame of both
  std::filesystem::path other;  ///< the other eye's file
};

/// What a JSON is looked for by.
struct JsonRequest {
  std::filesystem::path frame;  ///< the EXR file
  std::filesystem::path json;   ///< --camera; empty: the one beside the EXR file
  Window display;               ///< cameras are in its pixels
  std::optional<EyeOfPair> eye;
};

struct JsonCameras {
  std::string name;                       ///< of the JSON file, for messages
  std::map<std::string, Camera> cameras;  ///< by view; "" of a JSON of one view; none where there is no JSON
  bool is_shared = false;                 ///< the JSON lies beside the other eye's file too

  /// The camera of a view of `wanted`, all views that need one; nullptr where there is none.
  const Camera* find(const std::string& view, const std::vector<std::string>& wanted) const;
};

/// Reads a camera JSON, or a display JSON where --camera names it. Throws Error for a JSON that cannot be read.
JsonCameras read_json_cameras(const JsonRequest& request, std::vector<std::string>& notes);

/// "cam.json has the view left, and frame.exr has the views ...": what the cameras are for, and what the frame has instead.
std::string misfit_in_words(const JsonCameras& json, const std::string& frame, const std::vector<std::string>& views);

}  // namespace gloam
