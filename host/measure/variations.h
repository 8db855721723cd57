// Variants of a preset: at another resolution or precision, or with other settings.
#pragma once

#include <string>
#include <vector>

#include "measure/plans.h"

namespace gloam::bench {

/// "half", "quarter", "precise", "double", "half-storage": all variants, in this order.
const std::vector<std::string>& variant_names();

/// The default variants: half, quarter, precise.
const std::vector<std::string>& default_variants();

/// A preset in one of these variants.
Variation with_variant(Variation base, const std::string& name);

/// Values that a parameter takes in turn.
struct Sweep {
  std::string parameter;
  std::vector<std::string> values;
};

/// Whether a technique has all parameters of the sweeps.
bool has_all(const Technique& technique, const std::vector<Sweep>& sweeps);

/// Empty, or the reason why a technique does not take a value: "hbao+: steps = '99' is not allowed; 1 to 32 is".
std::string not_allowed(const Technique& technique, const std::string& parameter, const std::string& value);

/// A preset with every allowed combination of the swept values, as "steps=9, directions=2". None if the technique lacks one of
/// the parameters.
std::vector<Variation> swept(const Variation& base, const std::vector<Sweep>& sweeps);

/// The preset of the variants: `medium` if it is among them, else the first; "" for none.
std::string base_preset(const std::vector<std::string>& presets);

}  // namespace gloam::bench
