// What of a capture can be had.
#pragma once

#include "gloam/scene/capture.h"

namespace gloam {

/// The name of the view that `CaptureOptions::second_view` adds.
inline constexpr const char* second_view_name = "view2";

/// Throws what `capture` says for options that cannot be had.
void check_options(const CaptureOptions& options);

}  // namespace gloam
