// A hard case: frames that are hard to get right, and a property that every technique of the registry must keep on them.
#pragma once

#include <string>
#include <vector>

#include "stress/probe.h"

namespace gloam::stress {

struct Case {
  int number;
  std::string name;      ///< "unit of the scene"
  std::string property;  ///< the property, in one sentence
  std::vector<void (*)(Probe&)> parts;
};

/// All cases, by number, from the files of stress/cases/.
const std::vector<Case>& cases();
/// Throws UsageError, with a list of the numbers, for an unknown one.
const Case& find_case(int number);

/// A reason in a technique's README.md for not holding the technique to a case, or to a part of one.
struct OptOut {
  int number;
  std::string part, technique;  ///< empty part: the whole case; empty technique: all techniques of the folder
  std::string reason;
};
/// The opt-outs that concern a technique.
std::vector<OptOut> opt_outs(const Technique& technique);

/// The result of one case on one technique.
struct CaseResult {
  std::string technique;
  int number = 0;
  std::string opted_out;                          ///< the reason; empty: not opted out
  std::vector<std::string> opted_out_parts = {};  ///< "open: reason"
  std::vector<std::string> passed_over;           ///< why parts or all of the case do not apply
  std::vector<Finding> findings;
  int trials = 0;
  double seconds = 0;
  std::string broken;     ///< the error that ended it early; empty: none
  std::string broken_on;  ///< the conditions of the trial that ended early
  bool held() const;
};

/// Runs a case. An exception from the driver or from gloam ends the case and is recorded in the result.
CaseResult examine(const Case& hard_case, const Subject& subject);

}  // namespace gloam::stress
