#include "evidence/coefficients.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gloam/error.h"
#include "technique/kernel_sources.h"

namespace gloam {
namespace {

using Json = nlohmann::json;

std::vector<float> numbers(const Json& set, const char* key, size_t count, const std::string& name) {
  const auto found = set.find(key);
  const bool is_list = found != set.end() && found->is_array() && found->size() == count &&
                       std::all_of(found->begin(), found->end(),
                                   [](const Json& n) { return n.is_number() && std::isfinite(n.get<float>()); });
  if (!is_list)
    throw UsageError("{}: '{}' of a set has to be a list of {} numbers; bench_fit writes such files", name, key, count);
  return found->get<std::vector<float>>();
}

std::optional<float> outside_of(const Json& set, const std::string& name) {
  const auto found = set.find("outside");
  if (found == set.end()) return {};
  if (!found->is_number() || !std::isfinite(found->get<float>()))
    throw UsageError("{}: 'outside' of a set has to be a number; bench_fit writes such files", name);
  return found->get<float>();
}

/// How unlike two samplings are: what is missed between samples goes with 1 / steps, noise with 1 / directions.
double distance(const EvidenceSet& set, int directions, int steps) {
  return std::hypot(1.0 / set.directions - 1.0 / directions, 1.0 / set.steps - 1.0 / steps);
}

}  // namespace

std::vector<EvidenceSet> evidence_sets(const std::string& text, const std::string& name) {
  const Json document = Json::parse(text, nullptr, false);
  if (!document.is_object() || !document.contains("sets") || !document["sets"].is_array() || document["sets"].empty())
    throw UsageError("{}: holds no coefficients; bench_fit writes such files", name);
  std::vector<EvidenceSet> sets;
  for (const Json& set : document["sets"]) {
    if (!set.is_object()) throw UsageError("{}: 'sets' has to be a list of sets; bench_fit writes such files", name);
    const auto whole = [&](const char* key) {
      if (!set.contains(key) || !set[key].is_number_integer() || set[key].get<int64_t>() < 1 ||
          set[key].get<int64_t>() > 1024)
        throw UsageError("{}: '{}' of a set has to be a whole number from 1 to 1024", name, key);
      return set[key].get<int>();
    };
    if (!set.contains("occluders") || !set["occluders"].is_string())
      throw UsageError("{}: 'occluders' of a set has to be depth, back_depth, peel or stochastic", name);
    sets.push_back({set["occluders"].get<std::string>(), whole("directions"), whole("steps"),
                    numbers(set, "closed", size_t(closed_terms), name),
                    numbers(set, "error", size_t(error_terms), name), outside_of(set, name)});
  }
  return sets;
}

const std::vector<EvidenceSet>& fitted_evidence_sets() {
  static const std::vector<EvidenceSet> sets =
      evidence_sets(kernel_sources().at("evidence/coefficients.json"), "evidence/coefficients.json");
  return sets;
}

const EvidenceSet* nearest_set(const std::vector<EvidenceSet>& sets, const std::string& occluders, int directions,
                               int steps) {
  const EvidenceSet* nearest = nullptr;
  for (const EvidenceSet& set : sets) {
    if (set.occluders != occluders) continue;
    if (!nearest || distance(set, directions, steps) < distance(*nearest, directions, steps)) nearest = &set;
  }
  return nearest;
}

}  // namespace gloam
