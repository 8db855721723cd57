// Savings and errors if views of a light-field display reuse the AO of key views for the same points.
#pragma once

#include "papers/study.h"

namespace gloam::bench {

/// States times and errors over all views of a stage, for the techniques for light-field displays. `middle`: a view by number;
/// `truth`: its traced AO.
void neighbouring_views(Study& study, const Stage& s, size_t middle, const Image& truth);

}  // namespace gloam::bench
