// The walk back from the planes asked for to the techniques that make them, and to the planes at hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plan/wanted.h"

namespace gloam {

/// Finds the techniques that make the wanted planes, and the planes at hand that they need.
class Walk {
 public:
  /// `also`: planes needed besides the outputs. The request's settings tell what techniques read, and its mask is needed before
  /// the outputs: `mask`, a plane; may be empty.
  Walk(const Wanted& wanted, const PlanRequest& request, std::vector<std::string> available,
       const std::vector<std::string>& also, const std::string& mask);

  Techniques order;  ///< techniques to run
  /// Planes that a technique makes as an extra.
  std::vector<std::pair<const Technique*, std::string>> extras;
  std::vector<std::string> inputs, missing;
  std::vector<std::pair<std::string, std::string>> skipped;  ///< what, why

 private:
  void need(const std::string& plane, const Technique* asking);
  void need_extra(const Technique& maker, const std::string& plane);
  void schedule(const Technique& technique);

  const Wanted& wanted_;
  const PlanRequest& request_;
  const std::vector<std::string> available_;
  Techniques begun_;
  std::vector<std::string> made_;
};

/// Throws MissingPlanes for everything that a walk missed, the cheapest remedy first. `technique`: the plan's name. `holds`: text
/// about what the file does hold.
[[noreturn]] void throw_missing(const std::string& technique, const Wanted& wanted, const Walk& walk,
                                const std::string& holds);

}  // namespace gloam
