#include "support/unoptimised.h"

// All suites: the frames are small.
[[maybe_unused]] const bool unoptimised = gloam::test::leave_unoptimised({""});
