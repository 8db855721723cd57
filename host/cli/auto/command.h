// The flags of gloam auto.
#pragma once

#include <optional>
#include <string>

#include "auto/automatic.h"
#include "auto/budget.h"
#include "cli/auto/composite.h"
#include "cli/flags/options.h"
#include "cli/flags/shot_flags.h"

namespace gloam::cli {

struct AutoCommand {
  std::string out, explain, compression = "zip";
  std::optional<MaskUse> mask;
  BudgetGoal goal;
  bool half = false, measure = false;
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  ShotFlags shot;
  AutoCompositeFlags composite;
  JsonFlag json;
  std::string given;  ///< flags that decide what is written, as text
};

}  // namespace gloam::cli
