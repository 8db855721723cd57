// PoCL aborts where its compiled kernels are damaged, and LLVM's handler of that signal, which it installs while it compiles, lets
// no other one have a say. So the libraries find this abort, and the one of assertions, in place of the C library's: the
// executable exports both (CMakeLists.txt).
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
