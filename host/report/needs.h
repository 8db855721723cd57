// The best measured setting for each need.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/front.h"

namespace gloam::report {

/// Whether a row is a plain preset over one layer: the page's fronts are over these.
bool is_plain_over_one_layer(const Row& row);

/// A need, and the best setting for it.
struct Choice {
  std::string need;
  std::optional<ClassPoint> best;  ///< empty if no measured setting meets it
};

/// Needs in the order of a table. A need for which nothing was measured (no peeled layers) is left out. Times and errors are
/// compared as they are printed, so that no setting is chosen for a difference that the table does not show: of equal RMSE the
/// fastest, of equal times the one with the least RMSE. A chosen plain setting is on the Pareto front of the plain settings over
/// one layer.
std::vector<Choice> choices(const ClassFront& measured);

}  // namespace gloam::report
