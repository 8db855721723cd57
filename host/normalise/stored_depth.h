// What a depth is found to hold, before it is converted: signs, marks for the background, steps.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/camera.h"
#include "gloam/frame.h"
#include "normalise/background.h"

namespace gloam {

/// Rows of values, wherever they lie.
struct DepthRows {
  std::function<const float*(int y)> row;
  int width = 0, height = 0;
};
DepthRows rows_of(const Channel& channel);

/// How distances are stored.
struct StoredDepth {
  float sign = 1;  ///< -1: all of them are negative
  Background background;
  bool is_in_unit_interval = false;  ///< nothing that is usable lies above 1
  bool is_usable = false;            ///< any pixel shows a surface
  std::vector<std::string> notes;    ///< a sentence for each assumption
};

/// `background`: what is known of it. `is_stated`: the user says what marks it; else the largest half, 65504, does where a share of the
/// pixels holds it and none more: a depth that was written as half cannot be farther.
/// `remedy`: the end of a note on that, "; --background says otherwise".
StoredDepth look_at_depth(const DepthRows& depth, const Background& background, bool is_stated,
                          const std::string& remedy);

/// A sentence on depth that nothing is stated of, and that is taken as it is.
std::string note_on_planar_depth(bool is_in_unit_interval);

/// So many pixels, and such a share of them, hold one value that no surface has by chance.
bool is_a_mark(long long pixels, long long of);

/// Sets the pixels of a value to +inf, if it is such a mark. Returns their share of all, or 0.
double mark_share(Channel& depth, float value);

/// A sentence on the depth of an orthographic camera whose steps, as float or half, are long beside a pixel: surfaces become stairs. With
/// distance, the pixels of such a camera do not grow as the steps do. Empty if they are not. `depth`: planar, infinite where there is no
/// surface.
std::string note_on_steps(const std::function<float(int x, int y)>& depth, const Layout& image, const Camera& camera,
                          bool is_half);

}  // namespace gloam
