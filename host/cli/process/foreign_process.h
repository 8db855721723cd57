// Other people's programs as child processes: timed whole, ended where they hang, and with whatever they started.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gloam::cli {

/// How a program ended.
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

/// A command line as words: spaces divide, quotes of both kinds keep together, \ keeps the next character. No shell takes part. Throws
/// UsageError, beginning with `flag`, for a quote without its end, for no word, and for operators of a shell.
std::vector<std::string> words_of_command(const std::string& command, const std::string& flag);

/// Puts values in place of {name}. {{ and }} are braces. Throws UsageError for a name that has no value.
std::string with_values(const std::string& word, const std::map<std::string, std::string>& values,
                        const std::string& flag);

}  // namespace gloam::cli
