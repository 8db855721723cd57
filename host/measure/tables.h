// Tables that `gloam bench` prints.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement.h"

namespace gloam::bench {

struct Table {
  std::string title;
  std::vector<std::vector<std::string>> rows;  ///< the first is the heading
  size_t first_number = 0;                     ///< columns from here on are numbers
  std::vector<std::string> below;              ///< lines below the table
};

/// Times and errors of all rows of one effect on one scene, last what there is without a technique; fastest preset first, variants under their preset. `*` marks the Pareto front over
/// all rows of the scene. Of many variants of a preset only those on the front have a line; `below` has the range of the others.
Table table_of_scene(const Measurement& measurement, const report::Scene& scene);

/// Rows compared with the naive kernels and the native loop; only the heading if there are none.
Table table_of_baselines(const Measurement& measurement, const report::Scene& scene);

Table table_of_growth(const Measurement& measurement);

}  // namespace gloam::bench
