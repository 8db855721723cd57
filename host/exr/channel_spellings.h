// The names that renderers give to the channels of each plane.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam::channel_names {

/// Certainty of a spelling: smaller wins.
enum Rank { own, renderer, generic, last_resort, only_rgba = 50 };

/// A layer, and its channels that make up a plane.
struct Spelling {
  std::string plane;
  std::string
      layer;  ///< canonical; "": no layer; "*": any layer, for channels whose own name is enough; "a+b*c": channel_sums.h
  std::string components;  ///< alternatives separated by '|', best first; the components of each separated by ','
  Rank rank;
  DeclaredConvention said = DeclaredConvention::nothing;
  float y_scale = 1;  ///< for the second component: -1 turns y up into y down
};

/// All spellings of all planes.
const std::vector<Spelling>& spellings();

/// The spellings of a plane, in the order of the table.
const std::vector<Spelling>& spellings_of(const std::string& plane);

/// Whether a layer (or part) holds data of another kind, so that its channels are never taken for a plane by their component alone.
bool is_other_data(const std::string& layer);

}  // namespace gloam::channel_names
