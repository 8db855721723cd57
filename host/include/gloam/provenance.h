// What a file says about how its planes were made.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/plan.h"
#include "gloam/run.h"

namespace gloam {

/// Header attributes of planes that plans made: `gloamTechnique` ("gtao", or several separated by commas), `gloamParameters`
/// ("gtao: radius=0.5 bias=0.01 ...; bilateral: ..."), `gloamRun` ("math=fast real=float seed=0"). `plans` may have one that was not
/// run, as nothing called for it: it is among the parameters alone, which decided that.
struct MadeBy {
  const Plan* plan;
  bool has_run = true;
};
std::map<std::string, std::string> provenance(const std::vector<MadeBy>& plans, const RunOptions& options);

}  // namespace gloam
