// Tests that take long.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace gloam::test {

/// Whether to run everything: GLOAM_TESTS=long in the environment, as set by `script/test --long`.
inline bool is_long_run() {
  const char* asked = std::getenv("GLOAM_TESTS");
  return asked && std::string(asked) == "long";
}

}  // namespace gloam::test

/// At the start of a test that takes more than ten seconds, or costs more than its findings are worth in every run.
#define ONLY_IN_LONG_RUN() \
  if (!gloam::test::is_long_run()) GTEST_SKIP() << "takes long: script/test --long runs it"
