// Which setting measured best for what someone needs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/front.h"

namespace gloam::report {

/// A preset as it stands, over one layer: what the page's fronts are over.
bool is_plain_over_one_layer(const Row& row);

/// A need, and what does it best.
struct Choice {
  std::string need;
  std::optional<ClassPoint> best;  ///< empty where no setting that was measured meets it
};

/// Needs in the order of a table. A need for which nothing was measured at all (no peeled layers) is left out. Times
/// and errors are compared as they are printed, so that no setting is chosen for what the table does not show: of those
/// with the same RMSE the fastest, of the fastest that with the least RMSE. A plain setting that is chosen is on the
/// Pareto front of the plain settings over one layer.
std::vector<Choice> choices(const ClassFront& measured);

}  // namespace gloam::report
