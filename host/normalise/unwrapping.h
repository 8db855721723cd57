// Whole numbers of 16 bits that wrap around, made to go on.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

inline constexpr double range_of_16_bits = 65536;
/// What is left of a difference once it has wrapped.
double modulo_16_bits(double difference);

inline constexpr int most_turns = 7;
/// By how many degrees the normal of a pixel is missed, if its value has wrapped 0, 1, 2, ... times.
struct TurnVote {
  int x = 0, y = 0;
  std::array<double, most_turns + 1> degrees{};
};
/// The share of votes that clearly say that a value has wrapped; 0 if it is so small that it may be chance, or most values fit no planar distance.
/// (Measured on 24 frames that do not wrap: 0.9 % at most.)
double share_of_wrapped(const std::vector<TurnVote>& votes);

using VoteOnTurns = std::function<std::vector<TurnVote>(const Channel& depth)>;

/// Values of one surface go on. How often one has wrapped, the normals on it tell; without them the nearest of all has not. A share of zeros is
/// nothing.
void unwrap(Channel& depth, const VoteOnTurns& vote);

}  // namespace gloam
