// The flags of gloam reference: shared by the files of the command.
#pragma once

#include <optional>
#include <string>

#include "cli/options.h"
#include "cli/scene_flags.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

struct ReferenceCommand {
  std::string what, frame, out, falloff = "none", picture, compression = "zip";
  std::string given;  ///< flags that decide what is written, as text
  std::optional<int> samples;
  std::optional<double> radius;
  int seed = 0;
  bool half = false, resume = false;
  FrameChoice choice;  ///< of a shot
  SceneFlags scene;
  FrameFlags frame_flags;
  JsonFlag json;
};

}  // namespace gloam::cli
