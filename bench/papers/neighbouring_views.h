// What it saves and costs where views of a light-field display take over what key views have found of the same points.
#pragma once

#include "bench/papers/study.h"

namespace gloam::bench {

/// Times and errors over all views of a stage, of the techniques for light-field displays. `middle`: a view by number; `truth`: AO
/// that rays find of it.
void neighbouring_views(Study& study, const Stage& s, size_t middle, const Image& truth);

}  // namespace gloam::bench
