#include "run/tuning.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gloam {

nlohmann::ordered_json document_of(const Tuning& tuning) {
  return {{"lanes", tuning.lanes},
          {"group", tuning.search.group},
          {"group_of_others", tuning.others.group},
          {"registers", tuning.search.registers},
          {"gathers_by_loads", tuning.gathers_by_loads}};
}

std::optional<Tuning> tuning_in(const nlohmann::ordered_json& document, const Tuning& usual) {
  if (!document.is_object()) return {};
  const int group = document.at("group");
  const Tuning tuning{document.at("lanes"),
                      {group, document.value("registers", 0)},
                      {document.value("group_of_others", group)},
                      document.value("gathers_by_loads", usual.gathers_by_loads)};
  const auto is_possible = [](const KernelTuning& kind) {
    return kind.group >= 0 && kind.group <= most_per_group && kind.registers >= 0;
  };
  if (!std::count(lane_widths.begin(), lane_widths.end(), tuning.lanes) || !is_possible(tuning.search) ||
      !is_possible(tuning.others))
    return {};
  return tuning;
}

std::string options_of(const Tuning& tuning) {
  return fmt::format("-D LANES={}{}", tuning.lanes, tuning.gathers_by_loads ? " -D GATHERS_BY_LOADS=1" : "");
}

const KernelTuning& of_kind(const Tuning& tuning, const Pass& pass) {
  return pass.footprint.is_wide ? tuning.search : tuning.others;
}

}  // namespace gloam
