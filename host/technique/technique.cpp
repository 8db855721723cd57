#include "gloam/technique.h"

#include <algorithm>
#include <filesystem>

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam {

/// Generated: one entry per folder of kernels/ that has a technique.cpp.
std::vector<std::vector<Technique>> technique_folders();

const std::vector<Technique>& registry() {
  static const std::vector<Technique> all = [] {
    std::vector<Technique> techniques;
    for (std::vector<Technique>& folder : technique_folders()) {
      for (Technique& technique : folder) techniques.push_back(std::move(technique));
    }
    std::sort(techniques.begin(), techniques.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return techniques;
  }();
  return all;
}

std::vector<std::string> technique_names() {
  std::vector<std::string> names;
  for (const Technique& technique : registry()) names.push_back(technique.name);
  return names;
}

bool makes_first_view_only(const Technique& technique) {
  if (technique.views < 2) return false;
  const std::vector<Pass> passes = technique.passes(ParameterValues(technique.parameters));
  return std::all_of(passes.begin(), passes.end(), [&](const Pass& pass) {
    const bool is_output = std::any_of(pass.writes.begin(), pass.writes.end(),
                                       [&](const Binding& b) { return contains(technique.writes, b.plane); });
    return !is_output || pass.on == On::first_view;
  });
}

bool takes(const Pass& pass, From where) {
  return std::any_of(pass.reads.begin(), pass.reads.end(), [&](const Binding& b) { return b.from == where; });
}

const std::string& source_of(const Technique& technique, const Pass& pass) {
  return pass.source.empty() ? technique.source : pass.source;
}

std::string folder_of(const Technique& technique) {
  const std::vector<Pass> passes = technique.passes(ParameterValues(technique.parameters));
  return std::filesystem::path(source_of(technique, passes.front())).parent_path().string();
}

const Technique& find_technique(const std::string& name) {
  for (const Technique& technique : registry()) {
    if (technique.name == name) return technique;
  }
  throw UsageError("no technique '{}'{} (gloam list techniques shows all)", name, suggestion(name, technique_names()));
}

}  // namespace gloam
