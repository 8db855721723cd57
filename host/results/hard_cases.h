// What `gloam stress` found: how many of the hard cases each technique holds.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "results/measurements.h"

namespace gloam::report {

struct HardCases {
  std::string device;
  std::map<std::string, HeldCases> techniques;
};

/// Whether a document has the form of `gloam stress --json`.
bool is_of_hard_cases(const Json& document);

/// Cases that concern a technique: one is held where all that was looked at in it holds. Throws Error naming the file and the entry.
HardCases hard_cases_of(const Json& document, const std::filesystem::path& file);

}  // namespace gloam::report
