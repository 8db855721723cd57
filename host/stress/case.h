// A hard case: frames that are hard to get right, and a property that every technique of the registry keeps on them.
#pragma once

#include <string>
#include <vector>

#include "stress/probe.h"

namespace gloam::stress {

struct Case {
  int number;
  std::string name;      ///< "unit of the scene"
  std::string property;  ///< what holds, as one sentence
  std::vector<void (*)(Probe&)> parts;
};

/// All cases, by number. Each file of stress/cases/ has some.
const std::vector<Case>& cases();
/// Throws UsageError with the numbers there are.
const Case& find_case(int number);

/// A reason in a technique's README.md not to be held to a case, or to a part of one.
struct OptOut {
  int number;
  std::string part, technique;  ///< empty: all of the case; all techniques of the folder
  std::string reason;
};
/// Those that concern a technique.
std::vector<OptOut> opt_outs(const Technique& technique);

/// What came of one case on one technique.
struct CaseResult {
  std::string technique;
  int number = 0;
  std::string opted_out;                          ///< the reason; empty: it was not
  std::vector<std::string> opted_out_parts = {};  ///< "open: reason"
  std::vector<std::string> passed_over;           ///< why some or all of it was not asked
  std::vector<Finding> findings;
  int trials = 0;
  double seconds = 0;
  std::string broken;     ///< what ended it before its time: an error of the driver; empty: nothing did
  std::string broken_on;  ///< the conditions of the trial that it ended
  bool held() const;
};

/// Goes through a case. What a driver or gloam throws ends it and is in the result.
CaseResult examine(const Case& hard_case, const Subject& subject);

}  // namespace gloam::stress
