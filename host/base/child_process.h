// Child processes: commands of gloam, so that a driver that crashes or hangs ends one of them and not all; and other people's programs,
// timed whole, ended where they hang, and with whatever they started.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gloam {

/// How a command of gloam ended.
struct ChildEnd {
  int status = 0;        ///< its exit status; -1: it did not exit by itself
  std::string ended_by;  ///< "signal 11 (Segmentation fault)", "no sign of life for 600 s"; empty if it exited
  std::string said;      ///< output on standard error
};

/// The last line that a child said, without the program's name: why it failed. Empty if it said nothing.
std::string last_line_of(const ChildEnd& end);

/// In a child: writes a line of JSON for the parent, a line of its own even after an incomplete one of a driver.
void say_to_parent(const nlohmann::ordered_json& line);

/// In a child: ends with the parent.
void end_with_parent();

/// Runs this program with other arguments, as a child. Calls `line` with each line of the child's standard output; kills the child
/// if it has written no line for `patience` seconds. `changes`: variables that the child's environment has in addition, or with other
/// values. May be called from several threads.
ChildEnd run_child(const std::vector<std::string>& arguments, double patience,
                   const std::function<void(const std::string&)>& line,
                   const std::map<std::string, std::string>& changes = {});

/// How another program ended.
struct ForeignEnd {
  int status = 0;  ///< its exit status; -1: it did not exit by itself
  std::string
      why;  ///< in words: "exit status 3", "signal 11 (Segmentation fault)", "still running after 60 s"; empty: status 0
  std::string said;  ///< the last line on standard error, else on standard output
  double ms = 0;     ///< from its start until it ended
};

/// `why` and `said` as one text; empty for status 0.
std::string in_words(const ForeignEnd& end);

/// Runs a program, found as shells find it, in a process group of its own, with nothing on standard input; what it prints is not shown. Its
/// group is killed after `timeout` seconds, when it has ended, and when a signal ends gloam. Throws Error if it cannot be started.
ForeignEnd run_foreign(const std::vector<std::string>& words, double timeout);

}  // namespace gloam
