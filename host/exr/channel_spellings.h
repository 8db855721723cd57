// How renderers spell the channels of each plane.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam::channel_names {

/// How sure a spelling is: smaller wins.
enum Rank { own, renderer, generic, last_resort, only_rgba = 50 };

/// A layer and the channels in it that make up a plane.
struct Spelling {
  const char* plane;
  const char* layer;       ///< canonical; "" = no layer at all; "*" = any layer, for channels whose own name is enough
  const char* components;  ///< alternatives, best first, separated by '|'; components of one separated by ','
  Rank rank;
  DeclaredConvention said = DeclaredConvention::nothing;
  float y_scale = 1;  ///< for the second component: -1 turns y up into y down
};

/// All of them, for the names of layers that mean something.
const std::vector<Spelling>& spellings();

/// Those of a plane, in the order of the table.
const std::vector<Spelling>& spellings_of(const std::string& plane);

/// Layers whose channels are never taken for something else by their component alone, as when the part is named so.
bool is_other_data(const std::string& layer);

}  // namespace gloam::channel_names
