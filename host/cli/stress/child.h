// Examines a technique in a child process, so that a driver that crashes ends only this process.
#pragma once

#include <string>
#include <vector>

#include "cli/stress/request.h"
#include "stress/document.h"

namespace gloam::cli {

/// In the child: examines, and writes a line on standard output for each trial that begins and each case that is done.
void examine_here(const StressCommand& flags);

/// In the parent: examines one technique in a child. If a case ends the child, starts another with the remaining cases.
class Examination {
 public:
  Examination(const StressCommand& flags, const StressRequest& request, std::string technique);

  std::vector<stress::CaseResult> results;
  stress::Json device;

  void run();

 private:
  std::vector<std::string> arguments() const;
  void take(const std::string& text);

  const StressCommand& flags_;
  std::string technique_;
  std::vector<int> left_;
  double patience_;
  int case_ = 0, trial_ = 0;
  std::string conditions_;
  stress::Json refused_;  ///< what the child says of what it refuses, with its exit status; null: nothing
};

}  // namespace gloam::cli
