// gloam/shot.h for callers that know the shot's files already.
#pragma once

#include "gloam/shot.h"
#include "sequence/sequence_files.h"

namespace gloam {

/// As `run_shot` of gloam/shot.h, of files at hand: the request's `inputs` and `frames` are not looked at. `as_read`: changes each frame
/// as it was read, if set.
ShotSummary run_shot(const SequenceFiles& files, const ShotRequest& request,
                     const std::function<std::shared_ptr<Device>()>& device, ShotEvents& events,
                     const std::function<void(Frame&)>& as_read = {});

}  // namespace gloam
