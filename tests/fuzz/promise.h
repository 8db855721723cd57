// The promise for every input: it is read, or refused by one Error of one line that names it.
#pragma once

#include <functional>
#include <string>

namespace gloam::fuzz {

/// Prints which property does not hold, and ends the program.
[[noreturn]] void fail(const std::string& what);

inline void require(bool holds, const char* what) {
  if (!holds) fail(what);
}

/// Requires one non-empty line that a terminal shows unchanged.
void require_one_line(const std::string& text);

/// Runs a reader; returns whether it accepted the input. Fails unless a refusal is an Error of one line with `name` in it; any
/// other exception is passed on and ends the program.
bool reads(const std::string& name, const std::function<void()>& work);

}  // namespace gloam::fuzz
