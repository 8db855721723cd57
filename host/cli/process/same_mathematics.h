// The C library's functions in the form that every CPU of an architecture has.
#pragma once

namespace gloam::cli {

/// glibc takes other code for sin, exp and others where the CPU has fused multiply-add, whose last bits differ. For `gloam set make`,
/// starts the program again with the setting (GLIBC_TUNABLES) that turns this off; it is read at the start only. Does nothing for
/// other commands, where it is set already, and where the program cannot be started again.
void restart_with_same_mathematics(int argc, char** argv);

}  // namespace gloam::cli
