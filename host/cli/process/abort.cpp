// PoCL aborts if its compiled kernels are damaged. LLVM installs a handler of that signal while it compiles, and the handler calls
// no other one. So the executable exports its own abort and its own failure of assertions (CMakeLists.txt), and the libraries call
// these instead of the C library's.
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "run/driver.h"

extern "C" [[noreturn, gnu::visibility("default")]] void abort() noexcept {
  gloam::before_abort();
  std::signal(SIGABRT, SIG_DFL);
  raise(SIGABRT);
  std::_Exit(134);
}

extern "C" [[noreturn, gnu::visibility("default")]] void __assert_fail(const char* assertion, const char* file,
                                                                       unsigned line, const char* function) noexcept {
  gloam::before_abort();
  std::fprintf(stderr, "%s:%u: %s: Assertion `%s' failed.\n", file, line, function, assertion);
  abort();
}
