// gloam stress in chunks: commands for several machines, and what they wrote as one.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/stress/request.h"
#include "stress/document.h"

namespace gloam::cli {

/// Flags that each chunk has in its own form.
const std::set<std::string>& not_of_stress_chunks();

/// Prints a command a line: each examines some of the techniques, or of a single one some of the cases, and writes its own file.
void print_stress_chunks(const StressCommand& flags, const StressRequest& request);

/// A file of --json, of an earlier run.
struct StressFile {
  std::string path;
  stress::Json document;
};

/// Documents of the same device and the same settings as one, as one process writes it where the files are in order. Throws Error where two hold the same case of a technique.
std::vector<stress::Json> joined(const std::vector<StressFile>& files);

/// Prints what joined documents hold, and every figure beyond its bound. Throws Error, for the exit status, if there are any, or if
/// techniques were not examined.
void judge(const std::vector<stress::Json>& documents, bool in_words);

}  // namespace gloam::cli
