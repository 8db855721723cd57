// In which turn the frames of a sequence are computed, where each goes on from the one before.
//
// What a frame holds must not depend on where a process began: several machines divide a sequence, and an interrupted run goes on. So
// a history is not endless. Frames form blocks by their numbers, and each block begins with the last frames of the block before, which are
// computed again, from an empty history, and not written.
#pragma once

#include <cstddef>
#include <vector>

namespace gloam {

/// Frames of a block: 0 to 63, 64 to 127, ...
constexpr int frames_of_block = 64;
/// Frames that are computed before a block, without being written.
constexpr int warm_up_of_block = 8;

/// One frame to compute. `frame`: its place in the list.
struct Turn {
  size_t frame;
  bool begins = false;  ///< with an empty history
  bool is_written = true;
};

/// A chunk's frames, after the `warm_up` frames that lead to it.
struct ChunkOfTurns {
  std::vector<int> numbers;
  size_t warm_up;
};

/// Chunks end where blocks do, so there may be fewer than `count`.
std::vector<ChunkOfTurns> chunks_of_blocks(const std::vector<int>& numbers, int count);

/// `numbers`: ascending. The first `warm_up` of them are computed, but not written: they lead to a chunk of a sequence. `is_whole`: for
/// each frame, whether its file is there and needs no change. It is left out unless a later frame that is computed goes on from it, and it
/// is written again where a frame that it goes on from is.
std::vector<Turn> turns_of(const std::vector<int>& numbers, size_t warm_up, const std::vector<bool>& is_whole);

}  // namespace gloam
