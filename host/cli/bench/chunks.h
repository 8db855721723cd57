// gloam bench in chunks: commands for several machines. gloam report joins what they write.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gloam::cli {

/// What to divide, and into how many commands.
struct BenchChunks {
  std::vector<std::string> repeated;    ///< words of each chunk
  std::string folder;                   ///< of --output: a pattern with a place for the chunk's number
  std::vector<std::string> scenes;      ///< empty: an own frame
  std::vector<std::string> techniques;  ///< named ones; empty: the command's own choice
  bool divides_techniques = false;
  bool has_growth = false;  ///< measured on the first scene only
  int chunks = 0;
};

/// Flags that each chunk has in its own form.
const std::set<std::string>& not_of_bench_chunks();

/// Prints a command a line: each measures some of the scenes or, where there are more chunks than scenes, some of the techniques on one
/// of them. Every row's baselines are measured beside it in any case.
void print_bench_chunks(const BenchChunks& divided);

}  // namespace gloam::cli
