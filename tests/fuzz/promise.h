// What has to hold for every input: it is read, or refused by one Error of one line that names it.
#pragma once

#include <functional>
#include <string>

namespace gloam::fuzz {

/// Ends the program, having said what does not hold.
[[noreturn]] void fail(const std::string& what);

inline void require(bool holds, const char* what) {
  if (!holds) fail(what);
}

/// One line that a terminal shows as it is, and not an empty one.
void require_one_line(const std::string& text);

/// Runs what reads an input: whether it was read, not refused. Fails unless the refusal is an Error of one line with
/// `name` in it; any other exception goes on, and ends the program.
bool reads(const std::string& name, const std::function<void()>& work);

}  // namespace gloam::fuzz
