#include "sequence/frame_locks.h"

#include "base/hash.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {
namespace {

/// The name's hash, since the pattern's own name may be as long as names can be.
std::filesystem::path lock_of(const FramePattern& output) {
  return output.folder() / fmt::format(".gloam-lock-{:016x}", hash_of(output.normal_name()));
}

}  // namespace

FrameLocks::FrameLocks(const FramePattern& output, const std::vector<int>& frames)
    : lock_(lock_of(output), ranges_of(frames)) {
  if (lock_.is_held_by_another())
    throw Error(
        "{}: another gloam is writing frames among {}-{}; wait for its end, or name other frames or another output",
        output.text(), frames.front(), frames.back());
}

}  // namespace gloam
