// The error types: a message for a person, and the exit status that goes with it.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// Text from a file or the command line, made safe for one line of a terminal: control characters (line ends too), characters that
/// change the direction of text, and bytes that are not UTF-8 become \xNN. Printable text stays as it is.
std::string printable(std::string_view text);

/// An error for the user: one line that names the thing, the value, what is allowed and what to do. The message is made printable,
/// whatever names are in it. The command `gloam` prints it and exits with `exit_status`. Elsewhere it is caught only to do
/// something else: add the name of the file, try the next input, list it with others.
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

/// " (did you mean 'x'?)" with the candidate that `name` abbreviates ("--rad" for "--radius"), else the one with the smallest edit
/// distance; empty if none is near, and for a name without letters.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b and c"
std::string enumerate(const std::vector<std::string>& items);

}  // namespace gloam
