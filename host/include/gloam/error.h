// The one error type: a full sentence for a person, and the exit status that goes with it.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// Text from a file or the command line as a terminal may show it: control characters and bytes that are not UTF-8
/// become \xNN. Text that has been through it stays as it is.
std::string printable(std::string_view text);

/// Something the user has to know, in one line that names the thing, the value, what is allowed and what to do.
/// Thrown with the full message; only `main` catches it. Exit status 1. The message is made printable, whatever names
/// are in it.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(printable(message)) {}
  template <typename... Args>
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(printable(fmt::format(format, std::forward<Args>(args)...))) {}
  virtual int exit_status() const { return 1; }
};

/// The command line itself is wrong (unknown name, value out of range). Exit status 2.
class UsageError : public Error {
 public:
  using Error::Error;
  int exit_status() const override { return 2; }
};

/// The candidate that `name` abbreviates ("--rad" of "--radius"), else the one with the smallest edit distance, as
/// " (did you mean 'x'?)"; empty when none is near, and for a name without letters.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// Text that is safe on a terminal and stays on one line: line ends become "; ", other control bytes "\\x1b".
std::string printable(std::string_view text);

/// "a, b and c"
std::string enumerate(const std::vector<std::string>& items);

}  // namespace gloam
