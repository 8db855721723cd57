// Commands of gloam in processes of their own, so that a driver that crashes or hangs ends one of them and not all.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gloam::cli {

/// How a child ended.
struct ChildEnd {
  int status = 0;        ///< its exit status; -1: it did not exit by itself
  std::string ended_by;  ///< "signal 11 (Segmentation fault)", "no sign of life for 600 s"; empty where it exited
  std::string said;      ///< on standard error
};

/// Runs this program with other arguments. Calls `line` with each line that it writes on standard output; kills it when it has
/// written none for `patience` seconds. May be called from several threads.
ChildEnd run_child(const std::vector<std::string>& arguments, double patience,
                   const std::function<void(const std::string&)>& line);

}  // namespace gloam::cli
