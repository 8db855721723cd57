#include "support/unoptimised.h"

// Of small frames, all of them.
[[maybe_unused]] const bool unoptimised = gloam::test::leave_unoptimised({""});
