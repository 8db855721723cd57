#include "sequence/turns.h"

#include <algorithm>

#include "sequence/chunks.h"

namespace gloam {
namespace {

int block_of(int number) { return number / frames_of_block; }

/// A block's frames, by their places: those that lead to it, and its own.
struct Block {
  size_t first, own, end;
};

std::vector<Block> blocks_of(const std::vector<int>& numbers, size_t warm_up) {
  std::vector<Block> blocks;
  for (size_t i = warm_up; i < numbers.size();) {
    Block block{i, i, i};
    while (block.end < numbers.size() && block_of(numbers[block.end]) == block_of(numbers[i])) ++block.end;
    while (block.first > 0 && block.own - block.first < size_t(warm_up_of_block)) --block.first;
    // A block that is begun elsewhere is led to by all that it is given.
    if (block.own == warm_up) block.first = 0;
    blocks.push_back(block);
    i = block.end;
  }
  return blocks;
}

}  // namespace

std::vector<ChunkOfTurns> chunks_of_blocks(const std::vector<int>& numbers, int count) {
  const std::vector<Block> blocks = blocks_of(numbers, 0);
  std::vector<int> places;
  for (size_t i = 0; i < blocks.size(); ++i) places.push_back(int(i));
  std::vector<ChunkOfTurns> chunks;
  for (const std::vector<int>& chunk : chunks_of(places, count)) {
    const Block &first = blocks[size_t(chunk.front())], &last = blocks[size_t(chunk.back())];
    chunks.push_back({{numbers.begin() + std::ptrdiff_t(first.first), numbers.begin() + std::ptrdiff_t(last.end)},
                      first.own - first.first});
  }
  return chunks;
}

std::vector<Turn> turns_of(const std::vector<int>& numbers, size_t warm_up, const std::vector<bool>& is_whole) {
  std::vector<Turn> turns;
  for (const Block& block : blocks_of(numbers, warm_up)) {
    const auto needs_work = [&](size_t i) { return i >= warm_up && !is_whole[i]; };
    size_t first = block.first;
    while (first < block.end && !needs_work(first)) ++first;
    if (first == block.end) continue;
    for (size_t i = block.first; i < block.end; ++i)
      turns.push_back({i, i == block.first, i >= block.own && i >= first});
  }
  return turns;
}

}  // namespace gloam
