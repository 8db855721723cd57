#include "python/interrupts.h"

#include <unistd.h>

#include <atomic>

#include "gloam/error.h"

namespace gloam::python {

void check_not_forked() {
  static std::atomic<pid_t> worked_in{0};
  pid_t nobody = 0;
  if (worked_in.compare_exchange_strong(nobody, ::getpid()) || nobody == ::getpid()) return;
  throw Error(
      "this process was forked from one in which gloam had worked, and neither OpenCL nor OpenMP lives through that; "
      "start "
      "processes by multiprocessing.get_context('spawn')");
}

void Interrupts::poll() {
  constexpr auto often_enough = std::chrono::milliseconds(50);
  if (std::this_thread::get_id() != caller_ || Clock::now() - last_ < often_enough) return;
  const PyGILState_STATE state = PyGILState_Ensure();
  const bool raised = PyErr_CheckSignals() != 0;
  PyGILState_Release(state);
  last_ = Clock::now();
  if (raised) throw Interrupted();
}

}  // namespace gloam::python
