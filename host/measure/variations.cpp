#include "measure/variations.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam::bench {

const std::vector<std::string>& variant_names() {
  static const std::vector<std::string> names = {"half", "quarter", "precise", "double", "half-storage"};
  return names;
}

const std::vector<std::string>& default_variants() {
  static const std::vector<std::string> names = {"half", "quarter", "precise"};
  return names;
}

Variation with_variant(Variation base, const std::string& name) {
  base.variant = name;
  if (name == "half") base.resolution = 2;
  if (name == "quarter") base.resolution = 4;
  if (name == "precise" || name == "double") base.math = Math::precise;
  if (name == "double") base.real = Real::float64;
  if (name == "half-storage") {
    base.variant = "half storage";
    base.storage = Storage::float16;
  }
  return base;
}

bool has_all(const Technique& technique, const std::vector<Sweep>& sweeps) {
  const ParameterValues values(technique.parameters);
  return std::all_of(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) { return values.has(sweep.parameter); });
}

std::string not_allowed(const Technique& technique, const std::string& parameter, const std::string& value) {
  ParameterValues values(technique.parameters);
  try {
    values.set(parameter, value, technique.name);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::vector<Variation> swept(const Variation& base, const std::vector<Sweep>& sweeps) {
  if (sweeps.empty() || !has_all(*base.technique, sweeps)) return {};
  std::vector<Variation> product = {base};
  for (const Sweep& sweep : sweeps) {
    std::vector<Variation> longer;
    for (const Variation& each : product) {
      for (const std::string& value : sweep.values) {
        if (!not_allowed(*base.technique, sweep.parameter, value).empty()) continue;
        Variation next = each;
        next.settings.emplace_back(sweep.parameter, value);
        next.variant += fmt::format("{}{}={}", next.variant.empty() ? "" : ", ", sweep.parameter, value);
        longer.push_back(std::move(next));
      }
    }
    product = std::move(longer);
  }
  return product;
}

std::string base_preset(const std::vector<std::string>& presets) {
  if (presets.empty() || contains(presets, "medium")) return presets.empty() ? "" : "medium";
  return presets.front();
}

}  // namespace gloam::bench
