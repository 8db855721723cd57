#include "results/hard_cases.h"

#include "base/json_object.h"
#include "gloam/error.h"

namespace gloam::report {

bool is_of_hard_cases(const Json& document) {
  return document.is_object() && document.contains("cases") && document.contains("failed");
}

HardCases hard_cases_of(const Json& document, const std::filesystem::path& file) {
  const JsonObject all(document, {file.string(), "remove the file, and gloam stress makes it anew"});
  std::map<std::string, std::map<double, bool>> held;  ///< technique -> case -> whether all of it holds
  for (const JsonObject& each : all.objects("cases")) {
    const bool holds = each.flag("held");
    const auto [known, is_new] = held[each.text("technique")].emplace(each.number("case"), holds);
    known->second = known->second && holds;
  }
  HardCases found{all.text_if("device"), {}};
  for (const auto& [technique, cases] : held) {
    HeldCases& counts = found.techniques[technique];
    counts.cases = cases.size();
    for (const auto& [number, holds] : cases) counts.held += holds;
  }
  return found;
}

}  // namespace gloam::report
