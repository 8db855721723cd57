// The flags of gloam run: shared by the files of the command.
#pragma once

#include <string>
#include <vector>

#include "cli/flags/composite_flags.h"
#include "cli/flags/options.h"
#include "cli/flags/shot_flags.h"

namespace gloam::cli {

struct RunCommand {
  std::string technique, out, into, outputs, picture, compression = "zip";
  bool bare = false, half = false;
  bool is_out_made = false;           ///< `out` was made of the frame's name
  std::string given;                  ///< flags that decide what is written, as text
  std::vector<std::string> repeated;  ///< words for a chunk of a shot
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  ShotFlags shot;
  CompositeFlags composite;
  JsonFlag json;
};

/// Whether each frame goes on from the one before.
bool is_temporal(const RunCommand& flags);

/// Runs, writes and prints. `request`: of the command's technique.
void run_on_frame(const RunCommand& flags, const PlanRequest& request);

/// Decodes, computes and writes neighbouring frames at the same time, in bounded memory. Throws Error at the end if a frame
/// failed; the others are written.
void run_on_shot(const RunCommand& flags, const PlanRequest& request);

}  // namespace gloam::cli
