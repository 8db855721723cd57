// In which turn frames that go on from one another are computed.
#include "sequence/turns.h"

#include <gtest/gtest.h>

#include <numeric>

namespace gloam::test::turns_test {
namespace {

std::vector<int> range(int first, int last) {
  std::vector<int> numbers(size_t(last - first + 1));
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// "57*-63* 64-66": a star for a frame that is not written, a space before one that begins.
std::string in_words(const std::vector<int>& numbers, const std::vector<Turn>& turns) {
  std::string words;
  for (const Turn& turn : turns)
    words += (turn.begins ? " " : ",") + std::to_string(numbers[turn.frame]) + (turn.is_written ? "" : "*");
  return words;
}

TEST(Turns, ABlockBeginsWithTheLastFramesOfTheOneBefore) {
  const std::vector<int> numbers = range(60, 66);
  EXPECT_EQ(in_words(numbers, turns_of(numbers, 0, std::vector<bool>(7, false))),
            " 60,61,62,63 60*,61*,62*,63*,64,65,66");
  const std::vector<int> many = range(1, 130);
  const std::vector<Turn> turns = turns_of(many, 0, std::vector<bool>(130, false));
  EXPECT_EQ(turns.size(), 130u + 2 * warm_up_of_block);
  std::vector<int> written(131);
  for (const Turn& turn : turns) {
    const int number = many[turn.frame];
    written[size_t(number)] += turn.is_written;
  }
  for (int number = 1; number <= 130; ++number) EXPECT_EQ(written[size_t(number)], 1) << number;
}

TEST(Turns, ChunksGiveEachFrameTheSameHistory) {
  for (const std::vector<int>& numbers : {range(1, 300), range(64, 64), std::vector<int>{1, 5, 62, 70, 200}}) {
    const std::vector<Turn> whole = turns_of(numbers, 0, std::vector<bool>(numbers.size(), false));
    std::vector<std::vector<int>> expected, found;
    const auto add_histories = [](const std::vector<int>& frames, const std::vector<Turn>& turns, auto& histories) {
      std::vector<int> history;
      for (const Turn& turn : turns) {
        if (turn.begins) history.clear();
        history.push_back(frames[turn.frame]);
        if (turn.is_written) histories.push_back(history);
      }
    };
    add_histories(numbers, whole, expected);
    for (const int count : {1, 2, 3, 100}) {
      found.clear();
      for (const auto& [frames, warm_up] : chunks_of_blocks(numbers, count))
        add_histories(frames, turns_of(frames, warm_up, std::vector<bool>(frames.size(), false)), found);
      EXPECT_EQ(found, expected) << count;
    }
  }
}

TEST(Turns, WhatGoesOnFromAFrameThatIsNotWholeIsWrittenAgain) {
  const std::vector<int> numbers = range(60, 66);
  std::vector<bool> is_whole(7, true);
  EXPECT_TRUE(turns_of(numbers, 0, is_whole).empty());
  is_whole[5] = false;  // 65
  EXPECT_EQ(in_words(numbers, turns_of(numbers, 0, is_whole)), " 60*,61*,62*,63*,64*,65,66");
  is_whole[2] = false;  // 62
  EXPECT_EQ(in_words(numbers, turns_of(numbers, 0, is_whole)), " 60*,61*,62,63 60*,61*,62*,63*,64,65,66");
}

}  // namespace
}  // namespace gloam::test::turns_test
