// Text in lines: where lines end, and tables of it.
#include "picture/text_block.h"

#include <gtest/gtest.h>

#include "gloam/error.h"
#include "picture/table.h"

namespace gloam::text_block_test {
namespace {

const TextStyle style{11};
using Lines = std::vector<std::string>;

const std::string sentence =
    "something rises over the surface within the radius on 85 % of the image, so a mask would cost more than it saves";

std::string joined(const Lines& lines) { return fmt::format("{}", fmt::join(lines, " ")); }

TEST(TextBlock, LinesEndBetweenWordsAndFit) {
  for (const double width : {100.0, 150.0, 333.0, 700.0}) {
    const Lines lines = wrapped(sentence, width, style);
    EXPECT_EQ(joined(lines), sentence) << width;
    EXPECT_GT(lines.size(), 1u) << width;
    for (const std::string& line : lines) EXPECT_LE(text_width(line, style), width) << line;
  }
  EXPECT_EQ(wrapped(sentence, 5000, style), Lines{sentence});
}

TEST(TextBlock, ALineTakesAsManyWordsAsFit) {
  const double width = text_width("one two", style);
  EXPECT_EQ(wrapped("one two three", width, style), (Lines{"one two", "three"}));
  EXPECT_EQ(wrapped("one two three", width - 0.5, style), (Lines{"one", "two", "three"}));
}

TEST(TextBlock, ANumberKeepsItsUnit) {
  const double narrow = text_width("of 85 %", style) - 0.5;
  EXPECT_EQ(wrapped("of 85 %", narrow, style), (Lines{"of", "85 %"}));
  EXPECT_EQ(wrapped("of 8.1 ms.", 1, style).size(), 2u);
  EXPECT_EQ(wrapped("of % ms", 1, style).size(), 3u);
}

TEST(TextBlock, AWordThatIsTooWideHasALineOfItsOwnWithoutItsMiddle) {
  const Lines lines = wrapped("a " + std::string(40, 'W') + "end b", 120, style);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "a");
  EXPECT_EQ(lines[2], "b");
  EXPECT_NE(lines[1].find("..."), std::string::npos);
  EXPECT_EQ(lines[1].substr(lines[1].size() - 3), "end");
  EXPECT_LE(text_width(lines[1], style), 120);
}

TEST(TextBlock, AnyWhiteSpaceSeparatesWords) {
  EXPECT_EQ(wrapped(" one\ttwo \n  three ", 500, style), Lines{"one two three"});
  EXPECT_TRUE(wrapped("", 500, style).empty());
  EXPECT_TRUE(wrapped(" \n ", 500, style).empty());
}

TEST(TextBlock, ParagraphsStandOneBelowTheOther) {
  const TextBlock block = block_of({{"first", style}, {"", style}, {sentence, style}}, 200, Align::right);
  ASSERT_GT(block.lines.size(), 3u);
  EXPECT_EQ(block.lines[0].text, "first");
  for (size_t i = 0; i < block.lines.size(); ++i) {
    EXPECT_EQ(block.lines[i].at.x, 200);
    EXPECT_LT(block.lines[i].at.y, block.height);
    if (i == 0) continue;
    EXPECT_GT(block.lines[i].at.y, block.lines[i - 1].at.y + int(style.size));
  }
}

/// A table of one row, whose column `why` takes the rest.
Table table_with(const std::string& why) {
  return {{{"name", Align::left, 80}, {"share", Align::right, 90}, {"why"}},
          {{{{"a name of many words", style}}, {{"34 %", style}}, {{why, style}}}}};
}

TEST(PictureTable, ColumnsDoNotTouch) {
  for (const int width : {300, 500, 1200}) {
    const PlacedTable table = placed(table_with(sentence), width);
    ASSERT_EQ(table.blocks.size(), 6u);  // with the headings
    for (size_t i = 0; i < table.blocks.size(); ++i) {
      for (const TextLine& line : table.blocks[i].lines) {
        const double w = text_width(line.text, line.style);
        const double left = table.corners[i].x + line.at.x - (line.align == Align::right ? w : 0);
        const double room = i % 3 == 2 ? width : table.corners[i + 1].x;
        EXPECT_GE(left, table.corners[i].x - 0.5) << line.text;
        EXPECT_LE(left + w, room + (i % 3 == 2 ? 0.5 : -12)) << line.text << " in " << width;
        EXPECT_LT(table.corners[i].y + line.at.y, table.height) << line.text;
      }
    }
    EXPECT_EQ(table.blocks[3].lines.size(), 3u);  // "a name", "of many", "words"
  }
}

TEST(PictureTable, ARowIsAsHighAsItsTallestCell) {
  const PlacedTable narrow = placed(table_with(sentence), 300), wide = placed(table_with("short"), 1200);
  EXPECT_GT(narrow.height, wide.height);
  ASSERT_EQ(narrow.rules.size(), 2u);
  for (const TextLine& line : narrow.blocks[5].lines)
    EXPECT_LT(narrow.corners[5].y + line.at.y, narrow.rules[1]) << line.text;
}

}  // namespace
}  // namespace gloam::text_block_test
