// Checks of capture options.
#pragma once

#include "gloam/scene/capture.h"

namespace gloam {

/// The name of the view that `CaptureOptions::second_view` adds.
inline constexpr const char* second_view_name = "view2";

/// Throws as `capture` does for impossible options.
void check_options(const CaptureOptions& options);

}  // namespace gloam
