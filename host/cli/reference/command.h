// The flags of gloam reference: shared by the files of the command.
#pragma once

#include <string>

#include "cli/flags/options.h"
#include "cli/flags/scene_flags.h"
#include "scene/reference_kinds.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

struct ReferenceCommand {
  ReferenceRequest request;
  std::string frame, out, picture, compression = "zip";
  bool keep_margin = false;
  std::string given;  ///< flags that decide what is written, as text
  int seed = 0;
  bool half = false, resume = false;
  FrameChoice choice;  ///< of a shot
  SceneFlags scene;
  FrameFlags frame_flags;
  JsonFlag json;
};

}  // namespace gloam::cli
