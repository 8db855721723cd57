#include "cli/shot/start.h"

#include "base/files.h"

namespace gloam::cli {

ShotStart::ShotStart(const NamedPatterns& outputs, const std::vector<int>& frames) {
  for (const auto& [flag, pattern] : outputs) {
    locks_.emplace_back(pattern, frames);
    remove_leftovers(pattern.folder());
  }
  say_on_interruption("frames that were written are whole; the same command with --resume goes on");
}

}  // namespace gloam::cli
