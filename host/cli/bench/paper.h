// gloam bench --paper NAME
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"

namespace gloam::cli {

struct PaperFlags {
  std::string paper, folder;
  DeviceFlags device;
  std::optional<Size> size;
  std::optional<int> rays;
  int rounds = 0;
};

std::vector<std::string> paper_names();

/// Repeats the paper's measurements, writes bench.json, PAPER.md and pictures to the folder, and prints the page.
void bench_paper(const PaperFlags& flags, const JsonFlag& json);

}  // namespace gloam::cli
