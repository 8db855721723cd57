// Protection from an OpenCL driver that ends the process: PoCL does so if its compiled kernels are damaged, or if no linker is
// found.
#pragma once

#include <string>

namespace gloam {

/// Whether PoCL keeps no compiled kernel: what runs next is compiled first.
bool pocl_keeps_nothing();

/// While an object of this class lives, the OpenCL driver is at work, and a signal that ends the process comes from the driver.
class DriverAtWork {
 public:
  DriverAtWork();
  ~DriverAtWork();
  DriverAtWork(const DriverAtWork&) = delete;
  DriverAtWork& operator=(const DriverAtWork&) = delete;
};

/// Restarts the command, once, if the driver ends the process, with an empty folder for compiled kernels. If it ends again,
/// throws Error with a likely cause. For `main`, before anything else; `arguments` must outlive the process. Does nothing in a
/// build with sanitizers, which have their own handlers.
void restart_where_the_driver_dies(char** arguments);

/// Call before aborting: restarts the command if the driver is at work, else returns.
void before_abort();

/// Call at the end of a restarted command that succeeded: the recompiled kernels replace the damaged ones. Returns one sentence
/// on what was done; empty if nothing was.
std::string keep_kernels_made_anew();

/// Call at the end of any command: removes recompiled kernels that were not kept.
void remove_kernels_made_anew();

/// ", at a limit of N MB (ulimit -v); raise it" if the process has a limit; else empty.
std::string memory_limit();

/// Restarts the command if the driver has failed as it does with damaged kernels. Returns if it was restarted before, or cannot be.
void restart_without_kept_kernels();

}  // namespace gloam
