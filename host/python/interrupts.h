// Work without the interpreter's lock, which Ctrl-C still ends.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace gloam::python {

/// Thrown through the work, with Python's exception set on the thread that called: KeyboardInterrupt, or what another handler raises.
struct Interrupted {};

/// Lets Python's handlers of signals run while a thread is at work without the interpreter's lock.
class Interrupts {
 public:
  /// Call now and then, from any thread of the work: it does something on the one that was called from Python, every 50 ms. Throws
  /// Interrupted if a handler raised.
  void poll();

 private:
  using Clock = std::chrono::steady_clock;
  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point last_ = Clock::now();
};

/// Throws Error in a process that was forked from one in which gloam has worked: neither a driver of OpenCL nor OpenMP lives through that.
void check_not_forked();

/// Calls `work(interrupts)` without the interpreter's lock. Neither the work nor its result may touch Python. Throws Error in a
/// forked process.
template <typename Work>
auto without_lock(const Work& work) {
  check_not_forked();
  Interrupts interrupts;
  try {
    const pybind11::gil_scoped_release released;
    return work(interrupts);
  } catch (const Interrupted&) {
    throw pybind11::error_already_set();
  }
}

}  // namespace gloam::python
