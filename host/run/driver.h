// An OpenCL driver that ends the process: PoCL does so where its compiled kernels are damaged, or where no linker is found.
#pragma once

#include <string>

namespace gloam {

/// While one lives, the OpenCL driver is at work, and a signal that ends the process is the driver's.
class DriverAtWork {
 public:
  DriverAtWork();
  ~DriverAtWork();
  DriverAtWork(const DriverAtWork&) = delete;
  DriverAtWork& operator=(const DriverAtWork&) = delete;
};

/// Starts the command again, once, where the driver ends the process: with an empty folder for compiled kernels. A second time
/// throws Error with what may be the cause. For `main`, before it does anything else; `arguments` outlive the process. Does
/// nothing in a build with sanitizers, which have their own handlers.
void restart_where_the_driver_dies(char** arguments);

/// What the command does before it aborts: starts again where the driver is at work, else returns.
void before_abort();

/// At the end of a command that was started again and did its work: the kernels compiled anew take the place of the damaged ones.
/// What was done, in one sentence; empty where nothing was.
std::string keep_kernels_made_anew();

/// At the end of any command: what was compiled anew and not kept is removed.
void remove_kernels_made_anew();

/// ", at a limit of N MB (ulimit -v); raise it" where the process has one; else empty.
std::string memory_limit();

/// Starts the command again where the driver has failed as it does with damaged kernels. Returns where it was started again before,
/// or cannot be.
void restart_without_kept_kernels();

}  // namespace gloam
