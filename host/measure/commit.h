// The commit of gloam that was built (commit.cmake).
#pragma once

namespace gloam::bench {

/// Twelve digits, with "-changed" if files differ from the commit; "unknown" if it was not built from a git checkout.
extern const char* const commit;

}  // namespace gloam::bench
