// On the small frames of unit tests PoCL takes far longer to optimise kernels than to compute with them. Precise bits do not hang
// on it: the hard cases compare lanes, devices, and oclgrind, which does not optimise either. In the long run all are optimised.
#include <cstdlib>

#include "support/long.h"

namespace gloam::test {
namespace {

[[maybe_unused]] const int set_before_opencl_is_opened =
    is_long_run() ? 0 : setenv("POCL_EXTRA_BUILD_FLAGS", "-cl-opt-disable", 0);

}  // namespace
}  // namespace gloam::test
