// Self-tests of a device: each kind of kernel on a small frame, against figures that are known (data/self_test.json).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/run.h"

namespace gloam::doctor {

using Json = nlohmann::ordered_json;

/// One kind of kernel, the request that runs it, and what must come out.
struct SelfTest {
  std::string kind;  ///< "stacks of depth layers"
  PlanRequest request;
  RunOptions options;
  bool of_modules = false;  ///< the frame is of a light-field display's modules, else of a room
  Json expected;            ///< as `figures_of` writes it; null: not yet known
};

/// The tests of a table. Throws Error for a table that cannot be read.
std::vector<SelfTest> self_tests(const std::string& table);
/// Those that a device can run.
std::vector<SelfTest> self_tests(const std::string& table, const DeviceInfo& info);

/// The technique whose raw AO is timed. Throws as `self_tests` does.
std::string measured_technique(const std::string& table);

/// What came out of a test.
struct Outcome {
  bool held = false;
  bool same_bits = false;
  std::string why;  ///< what is wrong, in one sentence; empty if the test held
};

/// Runs a test. Precise mathematics must give the known bits, where the device rounds as IEEE 754 says; else nearly all values must
/// be near the known ones. An error of the driver or of gloam is an outcome.
Outcome examine(const SelfTest& test, Device& device);

/// The figures of a test on a device, for the table: a hash of all bits, the mean of each channel, and some of its values.
Json figures_of(const SelfTest& test, Device& device);

}  // namespace gloam::doctor
