// The flags of gloam auto, and what it prints: shared by the files of the command.
#pragma once

#include <optional>
#include <string>

#include "auto/automatic.h"
#include "auto/budget.h"
#include "auto/report.h"
#include "cli/auto/composite.h"
#include "cli/flags/options.h"
#include "cli/flags/shot_flags.h"
#include "gloam/explanation.h"

namespace gloam::cli {

struct AutoCommand {
  std::string out, explain, compression = "zip";
  std::optional<MaskUse> mask;
  Goal goal;
  bool half = false, measure = false;
  bool is_out_made = false;  ///< `out` was made of the frame's name
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  ShotFlags shot;
  AutoCompositeFlags composite;
  JsonFlag json;
  std::string given;  ///< flags that decide what is written, as text
};

/// Decides for each frame by itself, at one radius for all, and tells in which frames each effect was wanted. Throws Error at the
/// end if a frame failed; the others are written.
void run_auto_on_shot(const AutoCommand& flags);

/// The table of effects, and for a budget a line of what was spent.
void print(const AutoResult& result, const Goal& goal);

/// The effects and their refinements, on one view. Points to planes of `result`.
std::vector<Explanation> explanations_of(const AutoResult& result, const std::string& view);

}  // namespace gloam::cli
