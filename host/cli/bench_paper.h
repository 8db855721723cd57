// gloam bench --paper NAME
#pragma once

#include <string>
#include <vector>

#include "cli/options.h"

namespace gloam::cli {

struct PaperFlags {
  std::string paper, folder, size, rounds, rays, device;
};

std::vector<std::string> paper_names();

/// Measures the paper again, writes bench.json, PAPER.md and pictures to the folder, and prints the page.
void bench_paper(const PaperFlags& flags, const JsonFlag& json);

}  // namespace gloam::cli
