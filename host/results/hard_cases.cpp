#include "results/hard_cases.h"

#include <fmt/format.h>

#include "results/json_object.h"

namespace gloam::report {

bool is_of_hard_cases(const Json& document) {
  return document.is_object() && document.contains("cases") && document.contains("failed");
}

HardCases hard_cases_of(const Json& document, const std::filesystem::path& file) {
  const Object all(document, file.string(), "");
  std::map<std::string, std::map<double, bool>> held;  ///< technique -> case -> whether all of it holds
  for (const Object& each : all.needed_list("cases")) {
    const Json holds = each.json().value("held", Json());
    if (!holds.is_boolean())
      throw Error("{}: a case of {} does not say whether it is held; remove the file, and gloam stress makes it anew",
                  file.string(), each.needed_text("technique"));
    const auto [known, is_new] =
        held[each.needed_text("technique")].emplace(each.needed_number("case"), holds.get<bool>());
    known->second = known->second && holds.get<bool>();
  }
  HardCases found{all.text("device"), {}};
  for (const auto& [technique, cases] : held) {
    HeldCases& counts = found.techniques[technique];
    counts.cases = cases.size();
    for (const auto& [number, holds] : cases) counts.held += holds;
  }
  return found;
}

}  // namespace gloam::report
