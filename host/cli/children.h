// Commands of gloam in child processes, so that a driver that crashes or hangs ends one of them and not all.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gloam::cli {

/// How a child ended.
struct ChildEnd {
  int status = 0;        ///< its exit status; -1: it did not exit by itself
  std::string ended_by;  ///< "signal 11 (Segmentation fault)", "no sign of life for 600 s"; empty if it exited
  std::string said;      ///< output on standard error
};

/// Runs this program with other arguments, as a child. Calls `line` with each line of the child's standard output; kills the child
/// if it has written no line for `patience` seconds. `changes`: variables that the child's environment has in addition, or with other
/// values. May be called from several threads.
ChildEnd run_child(const std::vector<std::string>& arguments, double patience,
                   const std::function<void(const std::string&)>& line,
                   const std::map<std::string, std::string>& changes = {});

}  // namespace gloam::cli
