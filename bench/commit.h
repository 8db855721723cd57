// Which commit of gloam this is; made at every build (commit.cmake).
#pragma once

namespace gloam::bench {

/// Twelve digits, with "-changed" where files differ from it; "unknown" where it was not built from a git checkout.
extern const char* const commit;

}  // namespace gloam::bench
