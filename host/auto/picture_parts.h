// What effects change in the picture, to be shown.
#pragma once

#include "auto/glance.h"
#include "gloam/auto.h"

namespace gloam {

/// Notes in the outcomes where each effect changes the picture, and of the part that it changes most the picture without it and with it: of
/// the frame's own pixels where the effect was computed, else of the look's. Returns the picture of all that was computed. `result`: after
/// everything ran.
Frame show_changes(const Frame& frame, const Glance& glance, const ComposeOptions& how, AutoResult& result);

}  // namespace gloam
