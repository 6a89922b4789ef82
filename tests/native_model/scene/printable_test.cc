#include "native_model/scene/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rotorub::scene {
namespace {

TEST(Printable, LeavesPlainTextAsItIs) {
  for (const std::string& text : std::vector<std::string>{
           "", "0.5 mm", "50 \xc2\xb5m", "\xe2\x82\xac, \xf0\x9f\x98\x80", "a\\b\"c"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");  // CSI in one character
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "abc"),
            "\\u202eabc");                          // from right to left
  EXPECT_EQ(printable("\xe2\x80\xa8"), "\\u2028");  // line separator
}

TEST(Printable, EscapesBytesThatAreNoText) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");                             // cut within a character
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");                    // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond Unicode
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable("abcde\xc2\xb5", 6), "abcde...");
  EXPECT_EQ(printable("abcd\x1b", 6), "abcd...");
  EXPECT_EQ(printable(std::string(1'000'000, 'x')).size(), kQuotedLength + 3);
}

// What was made printable once is not changed again.
TEST(Printable, Twice) {
  const std::string once = printable("\x1b[31m\n\xff\xc2\x9b");
  EXPECT_EQ(printable(once), once);
}

}  // namespace
}  // namespace rotorub::scene
