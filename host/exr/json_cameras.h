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

/// For an EXR file that holds one eye of two.
struct EyeOfPair {
  std::string name;             ///< the view's name in the frame of both eyes
  std::filesystem::path other;  ///< the other eye's file
};

/// The files that decide which JSON is read.
struct JsonRequest {
  std::filesystem::path frame;  ///< the EXR file
  std::filesystem::path json;   ///< --camera; empty: the one beside the EXR file
  std::string text;             ///< of the JSON if it is at hand; else empty
  Window display;               ///< cameras are in pixels of it
  std::optional<EyeOfPair> eye;
  std::string
      frame_in_header;  ///< the number of the frame by the EXR file's header, as Blender writes it ("Frame"); may be empty
};

struct JsonCameras {
  std::string name;                       ///< of the JSON file, for messages
  std::map<std::string, Camera> cameras;  ///< by view; under "" if the JSON has one view; empty without a JSON
  bool is_shared = false;                 ///< the JSON also belongs to the other eye's file

  /// The camera of a view; nullptr if there is none. `wanted`: all views that need one.
  const Camera* find(const std::string& view, const std::vector<std::string>& wanted) const;
};

/// Reads a camera JSON, or a display JSON if --camera names it. Throws Error for a JSON that cannot be read.
JsonCameras read_json_cameras(const JsonRequest& request, std::vector<std::string>& notes);

/// "cam.json has the view left, and frame.exr has the views ...": the views of the cameras, and those of the frame.
std::string misfit_in_words(const JsonCameras& json, const std::string& frame, const std::vector<std::string>& views);

}  // namespace gloam
