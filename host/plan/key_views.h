// Which views of a row of many are key views, and which key views the others reuse.
#pragma once

#include <vector>

namespace gloam {

struct KeyViewRole {
  bool is_key = false;
  int nearest = -1,
      far = -1;  ///< numbers of the nearest key view and of the nearest one on the other side (or the same again)
};

/// Roles of `count` views in the order of the frame. Every `spacing`-th is a key view, and the views at both ends are no further
/// from one than the others. `spacing`: at least 2.
std::vector<KeyViewRole> key_view_roles(int count, int spacing);

}  // namespace gloam
