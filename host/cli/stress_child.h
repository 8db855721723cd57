// A technique is examined in a process of its own, so that a driver that ends it ends nothing else.
#pragma once

#include <string>
#include <vector>

#include "cli/stress_request.h"
#include "stress/document.h"

namespace gloam::cli {

/// In the child: examines and tells on standard output, a line for each trial that begins and for each case that is done.
void examine_here(const StressCommand& flags);

/// In the parent: one technique in a child, again with the cases that are left where one ends it.
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
};

}  // namespace gloam::cli
