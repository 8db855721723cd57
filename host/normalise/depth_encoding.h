// What was done to a depth before it was stored, beside what its values mean, and how to undo it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/conventions.h"
#include "gloam/frame.h"
#include "normalise/unwrapping.h"

namespace gloam {

/// "srgb,bottom-up"; "plain" for none.
std::string in_words(const DepthEncoding& encoding);
/// An encoding by its words; none for "auto". Throws UsageError, naming the flag, for others.
std::optional<DepthEncoding> parse_depth_encoding(const std::string& text, const std::string& flag);

/// Throws UsageError, naming the flag, for an encoding that is stated of values that cannot have it.
void check(const DepthEncoding& encoding, const Channel& depth, const std::string& flag);

/// Undoes an encoding in place. With the sRGB curve, values are shares of what is white, and become that: of 1, or of the largest whole number of
/// 8 or 16 bits where they reach beyond. `vote`: how normals see whole numbers that wrap.
void undo(const DepthEncoding& encoding, Channel& depth, const VoteOnTurns& vote = {});

/// A value of the depth with the sRGB curve undone, as above.
std::function<float(float value)> without_curve(const Channel& depth);

/// Whether the curve can be undone: nothing lies beyond what is white. Infinite values and NaN stay.
bool may_have_curve(const Channel& depth);

/// Whether whole numbers of 16 bits reach so far that some of them may have wrapped.
bool may_wrap(const Channel& depth);

/// Whole numbers of 16 bits that wrap around: where a surface goes on past 65535, they begin again at 0, or at -32768.
struct Wraps {
  long long neighbours = 0;  ///< that do so; 0 if that may be chance
  bool is_sure = false;      ///< else some of them may
};
Wraps count_wraps(const Channel& depth);

}  // namespace gloam
