#include "fuzz/promise.h"

#include <cstdio>
#include <cstdlib>

#include "gloam/error.h"

namespace gloam::fuzz {

void fail(const std::string& what) {
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what.c_str());
  std::abort();
}

void require_one_line(const std::string& text) {
  require(!text.empty(), "a message says something");
  if (printable(text) != text) fail("a message is one line that can be shown: " + text);
}

bool reads(const std::string& name, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    require_one_line(error.what());
    if (std::string(error.what()).find(name) == std::string::npos)
      fail("a message names '" + name + "': " + error.what());
    return false;
  }
}

}  // namespace gloam::fuzz
