// Kernels that PoCL compiles without optimisation: for tests that compile far longer than they compute.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "support/long.h"

namespace gloam::test {

/// While a suite runs whose name begins with one of these ("": all suites), PoCL does not optimise. Precise bits do not depend on
/// it: the hard cases compare lanes, devices, and oclgrind, which does not optimise either. In the long run all kernels are
///    optimised.
class Unoptimised : public testing::EmptyTestEventListener {
 public:
  explicit Unoptimised(std::vector<std::string> suites) : suites_(std::move(suites)) {}

  void OnTestSuiteStart(const testing::TestSuite& suite) override {
    if (is_long_run()) return;
    for (const std::string& name : suites_) {
      if (std::string(suite.name()).starts_with(name)) set();
    }
  }
  void OnTestSuiteEnd(const testing::TestSuite&) override {
    if (is_set_) unsetenv(variable);
    is_set_ = false;
  }

 private:
  static constexpr const char* variable = "POCL_EXTRA_BUILD_FLAGS";

  void set() {
    if (is_set_ || std::getenv(variable)) return;
    setenv(variable, "-cl-opt-disable", 1);
    is_set_ = true;
  }

  std::vector<std::string> suites_;
  bool is_set_ = false;
};

/// Before main: gtest owns it.
inline bool leave_unoptimised(std::vector<std::string> suites) {
  testing::UnitTest::GetInstance()->listeners().Append(new Unoptimised(std::move(suites)));
  return true;
}

}  // namespace gloam::test
