#include "measure/wanted_rows.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"
#include "measure/variations.h"

namespace gloam::bench {
namespace {

/// "steps=4, directions=2"; empty where the text is of another form.
Settings settings_in(const std::string& variant) {
  Settings settings;
  for (size_t start = 0; start < variant.size();) {
    const size_t end = std::min(variant.find(", ", start), variant.size());
    const std::string item = variant.substr(start, end - start);
    const size_t equals = item.find('=');
    if (equals == std::string::npos) return {};
    settings.emplace_back(item.substr(0, equals), item.substr(equals + 1));
    start = end + 2;
  }
  return settings;
}

}  // namespace

Variation variation_of(const Technique& technique, const std::string& preset, const std::string& variant,
                       double radius) {
  Variation base{&technique, preset == "default" ? "" : preset, radius};
  if (variant.empty()) return base;
  const std::string name = variant == "half storage" ? "half-storage" : variant;
  if (contains(variant_names(), name)) return with_variant(base, name);
  base.settings = settings_in(variant);
  base.variant = variant;
  if (base.settings.empty())
    throw UsageError("{} {}: variant '{}' is not known; {} and NAME=VALUE are", technique.name, preset, variant,
                     enumerate(variant_names()));
  return base;
}

std::vector<Variation> wanted_variations(const std::vector<WantedRow>& rows, const Technique& technique, double radius,
                                         const std::string& scene, const std::string& effect) {
  std::vector<Variation> variations;
  for (const WantedRow& row : rows) {
    if (row.technique != technique.name || row.effect != effect || (!row.scene.empty() && row.scene != scene)) continue;
    variations.push_back(variation_of(technique, row.preset, row.variant, radius));
  }
  return variations;
}

}  // namespace gloam::bench
