// Rows that an earlier result has, measured again.
#pragma once

#include <string>
#include <vector>

#include "measure/plans.h"

namespace gloam::bench {

/// A row by its names, as bench.json has them.
struct WantedRow {
  std::string technique, preset, variant, scene, effect;  ///< no scene: any
};

/// A technique's variation by the names of its preset and variant, as a row has them: "steps=4, directions=2" are settings. Throws
/// UsageError for a variant that this version does not know.
Variation variation_of(const Technique& technique, const std::string& preset, const std::string& variant,
                       double radius);

/// The variations of a technique among the rows of one scene and effect.
std::vector<Variation> wanted_variations(const std::vector<WantedRow>& rows, const Technique& technique, double radius,
                                         const std::string& scene, const std::string& effect);

}  // namespace gloam::bench
