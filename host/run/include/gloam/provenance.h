// Header attributes that say how a file's planes were made.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// `gloamTechnique` ("gtao", or several separated by commas), `gloamParameters` ("gtao: radius=0.5 bias=0.01 ...; bilateral: ..."),
/// `gloamRun` ("math=fast real=float seed=0"). `plans` may include one that was not run because the frame does not call for it:
/// only its parameters are recorded, since they decided that.
struct MadeBy {
  const Plan* plan;
  bool has_run = true;
};
std::map<std::string, std::string> provenance(const std::vector<MadeBy>& plans, const RunOptions& options);

}  // namespace gloam
